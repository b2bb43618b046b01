#include "edgevo/odometry/mapper.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/rule.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/mapping/idepth_prior.h"
#include "first_keyframes.h"

namespace edgevo {
namespace {

// Points of the first window: fewer do not hold its poses against outliers.
constexpr int kMinFirstPoints = 100;
constexpr int kMaxAgeKeyframes = 4;  // immature points older than this are dropped

// Runs `work` and notes its CPU time under `name`.
template <class Work>
auto timed(const char* name, StageTimes* times, const Work& work) {
  const double start = thread_cpu_ms();
  struct Note {
    const char* name;
    StageTimes* times;
    double start;
    ~Note() { times->emplace_back(name, thread_cpu_ms() - start); }
  } note{name, times, start};
  return work();
}

}  // namespace

Mapper::Mapper(const Pinhole& pinhole, const MappingParams& params, const AssociationParams& association,
               bool gradient_patches, uint64_t seed)
    : pinhole_(pinhole),
      params_(params),
      association_(association),
      gradient_patches_(gradient_patches),
      random_(Random::derive(seed, 2)),
      window_(pinhole, params.window, association),
      calibration_(pinhole, SelfCalibrationParams{"none"}) {}

std::string Mapper::initialise(const BootstrapResult& bootstrap) {
  window_ = Window(pinhole_, params_.window, association_);
  tracking_check_ = {};
  const std::vector<const BootstrapView*> chosen = choose_keyframe_views(bootstrap.views);
  for (const BootstrapView* view : chosen) {
    Keyframe k;
    k.id = next_id_ + int(window_.keyframes().size());
    k.frame_index = view->frame_index;
    k.time = view->time;
    k.pyramid = view->pyramid;
    k.T_cam_world = view->T_cam_first;
    if (view == chosen.front() || view == chosen.back())
      k.immature = first_points(k, bootstrap.corners, view == chosen.back());
    window_.add(std::move(k));
  }
  for (const BootstrapView& view : bootstrap.views) {
    if (!view.placed || !view.pyramid) continue;
    for (Keyframe& k : window_.keyframes())
      if (view.frame_index != k.frame_index)
        update_depths(*view.pyramid, view.T_cam_first * k.T_cam_world.inverse(), params_.depth_filter, &k);
  }
  for (Keyframe& k : window_.keyframes())
    smooth_along_edges(k.pyramid->finest().edges, params_.depth_filter, &k.immature);
  window_.hold_bootstrap_scale();
  window_.activate(1, 1);
  window_.adjust();
  const WindowStats stats = window_.adjust();
  if (stats.points < kMinFirstPoints)
    return "only " + std::to_string(stats.points) + " edge points matched in the first views";
  next_id_ += int(chosen.size());
  publish(window_.newest());
  return {};
}

std::vector<ImmaturePoint> Mapper::first_points(const Keyframe& keyframe,
                                                const std::vector<BootstrapCorner>& corners, bool is_last) {
  const CellGrid grid(pinhole_.width, pinhole_.height, params_.depth_filter.cell_px);
  return make_immature_points(
      keyframe, std::vector<bool>(grid.size(), false),
      [&](const Eigen::Vector2d& px) { return range_near(corners, is_last, px); }, params_.depth_filter,
      &random_);
}

MapUpdate Mapper::process(const TrackedFrame& tracked) {
  MapUpdate update;
  TrackedFrame frame = tracked;
  frame.pyramid = corrected(tracked);
  if (frame.pyramid != tracked.pyramid) frame.corners.clear();  // they were seen in images of before
  const auto& known = reference_->T_keyframe_world;
  const auto reference_pose = known.find(frame.reference_id);
  // The frame's reference may have left the window meanwhile (two threads): such a frame comes too late to
  // help.
  if (reference_pose == known.end()) return update;
  const SE3 T_cam_world = frame.T_cam_ref * reference_pose->second;
  timed("depth_filter", &update.times, [&] {
    for (Keyframe& host : window_.keyframes())
      if (!host.immature.empty())
        update_depths(*frame.pyramid, T_cam_world * host.T_cam_world.inverse(), params_.depth_filter, &host);
  });
  if (frame.make_keyframe)
    make_keyframe(frame, T_cam_world, &update);
  else if (frame.return_to >= 0)
    timed("window", &update.times, [&] { return_to(frame.return_to); });
  return update;
}

void Mapper::make_keyframe(const TrackedFrame& frame, const SE3& T_cam_world, MapUpdate* update) {
  Keyframe keyframe;
  keyframe.id = next_id_++;
  keyframe.frame_index = frame.frame_index;
  keyframe.time = frame.time;
  keyframe.pyramid = frame.pyramid;
  keyframe.motion = frame.motion;
  keyframe.T_cam_world = T_cam_world;
  if (!frame.corners.empty()) keyframe.corners_from = frame.reference_id, keyframe.corners = frame.corners;
  update->keyframe_id = keyframe.id;
  window_.add(std::move(keyframe));

  timed("association", &update->times, [&] { window_.associate_newest(frame.covariance); });
  timed("activation", &update->times, [&] {
    for (Keyframe& host : window_.keyframes())
      smooth_along_edges(host.pyramid->finest().edges, params_.depth_filter, &host.immature);
    window_.take_back();
    window_.activate(2, params_.window.min_matches);
    // Large motion leaves the map behind before points are seen often: then one depth and one match must do.
    // What the first pass has tried, with two depths, is not tried again.
    if (rule("lent points")) window_.activate(1, 1, window_.points_lacking());
  });
  timed("bundle_adjustment", &update->times, [&] { update->stats = window_.adjust(); });
  if (update->stats.points > 0) check_tracking(frame);  // where it failed it moved nothing
  if (window_.full()) {
    timed("window", &update->times, [&] {
      retired_.push_back(window_.remove_oldest());
      calibration_.remember(retired_.back());
    });
    timed("edge_map", &update->times, [&] { map_edges(retired_.back()); });
  }
  if (calibration_.is_running() ||
      calibration_.is_due(int(window_.keyframes().size())))  // once in a long while
    timed("self_calibration", &update->times, [&] { calibrate_on_the_way(); });
  timed("window", &update->times, [&] {
    seed_points(&window_.newest());
    publish(window_.newest());
  });
}

// What the adjustment made of the pose that tracking had found for the newest keyframe.
void Mapper::check_tracking(const TrackedFrame& frame) {
  for (const Keyframe& k : window_.keyframes())
    if (k.id == frame.reference_id)
      tracking_check_.add(frame.T_cam_ref, relative_pose(window_.newest(), k), frame.covariance);
}

void Mapper::enable_self_calibration(const SelfCalibrationParams& params, const RebuildPyramid& rebuild,
                                     bool own_thread) {
  calibration_ = SelfCalibration(pinhole_, params);
  rebuild_ = rebuild;
  calibration_has_thread_ = own_thread;
}

void Mapper::enable_edge_map(const EdgeMapParams& params, bool own_thread) {
  edge_mapper_ = std::make_unique<EdgeMapper>(pinhole_, params, own_thread);
}

// Of a keyframe that has just left the window.
void Mapper::map_edges(const Keyframe& keyframe) {
  if (edge_mapper_) edge_mapper_->add(keyframe, window_.keyframes());
}

void Mapper::calibrate_on_the_way() {
  if (calibration_has_thread_ && !calibration_.is_running())
    calibration_.begin(window_pointers(), calibration_options());
  else if (!calibration_.is_running() || calibration_.is_ready())
    calibrate(false);
}

std::vector<const Keyframe*> Mapper::window_pointers() const {
  std::vector<const Keyframe*> window;
  for (const Keyframe& k : window_.keyframes()) window.push_back(&k);
  return window;
}

BaOptions Mapper::calibration_options() const {
  BaOptions options;
  options.huber_width = params_.window.ba_huber;
  return options;
}

void Mapper::calibrate(bool at_end) {
  std::optional<MapRevision> revision =
      calibration_.estimate(window_pointers(), calibration_options(), at_end);
  if (!revision) return;
  window_.apply(*revision, [&](const Keyframe& k) { return rebuild_(*k.pyramid, k.motion, revision->now); });
  if (edge_mapper_) edge_mapper_->apply(*revision);
  for (RevisedKeyframe& k : revision->keyframes) revised_.push_back(std::move(k));
}

// A frame that was on its way while the camera was corrected.
std::shared_ptr<const FramePyramid> Mapper::corrected(const TrackedFrame& tracked) const {
  const ImageCorrection now = calibration_.state().correction();
  return tracked.pyramid->correction == now || !rebuild_ ? tracked.pyramid
                                                         : rebuild_(*tracked.pyramid, tracked.motion, now);
}

// Every immature point is searched in every frame: as many as it takes to fill the window again, and not
// more.
int Mapper::new_points_wanted() const {
  constexpr int kAtLeast = 300;  // points a keyframe: also a full window needs some where the view is new
  const DepthFilterParams& p = params_.depth_filter;
  if (!rule("new points as wanted")) return p.max_new_points;
  const int lacking = std::max(0, params_.window.max_points - window_.active_points());
  return std::clamp(int(std::lround(p.candidates_per_point * lacking)), std::min(kAtLeast, p.max_new_points),
                    p.max_new_points);
}

// Drops immature points that are dead or too old, and makes new ones in the newest keyframe where the map has
// none.
void Mapper::seed_points(Keyframe* keyframe) {
  for (Keyframe& host : window_.keyframes()) {
    auto& points = host.immature;
    for (ImmaturePoint& p : points) p.dead |= ++p.age > kMaxAgeKeyframes;
    points.erase(std::remove_if(points.begin(), points.end(), [](const ImmaturePoint& p) { return p.dead; }),
                 points.end());
  }
  IdepthPrior prior(pinhole_, params_.depth_filter, median_idepth_);
  for (const CloudPoint& p : window_.cloud(*keyframe)) prior.add(p.px.cast<double>(), p.idepth);
  median_idepth_ = prior.median();
  std::vector<bool> occupied(prior.grid().size());
  for (int c = 0; c < prior.grid().size(); ++c) occupied[c] = prior.occupied(c);
  DepthFilterParams wanted = params_.depth_filter;
  wanted.max_new_points = new_points_wanted();
  keyframe->immature = make_immature_points(
      *keyframe, occupied, [&](const Eigen::Vector2d& px) { return prior.range(px); }, wanted, &random_);
}

void Mapper::publish(const Keyframe& keyframe) {
  auto reference = std::make_shared<Reference>();
  reference->keyframe_id = keyframe.id;
  reference->T_ref_world = keyframe.T_cam_world;
  reference->camera = calibration_.state();
  reference->cloud =
      make_reference_cloud(keyframe.pyramid, window_.tracking_cloud(keyframe), gradient_patches_);
  reference->known_points = int(window_.cloud(keyframe).size());
  reference->view_share = window_.view_share(keyframe);
  reference->median_idepth = median_idepth_;
  reference->error_factor = tracking_check_.error_factor();
  for (const Keyframe& k : window_.keyframes()) reference->T_keyframe_world[k.id] = k.T_cam_world;
  reference_ = std::move(reference);
}

// The camera is back near an older keyframe: what follows is tracked against that one, and does not drift
// away from it.
void Mapper::return_to(int keyframe_id) {
  const auto& keyframes = window_.keyframes();
  const auto old = std::find_if(keyframes.begin(), keyframes.end(),
                                [&](const Keyframe& k) { return k.id == keyframe_id; });
  if (old != keyframes.end() && keyframe_id != reference_->keyframe_id) publish(*old);
}

void Mapper::close() {
  calibrate(true);
  calibration_.forget();
  while (!window_.keyframes().empty()) {
    retired_.push_back(std::move(window_.keyframes().front()));
    window_.keyframes().pop_front();
    map_edges(retired_.back());
  }
  if (edge_mapper_)
    for (HostedLines& lines : edge_mapper_->close()) lines_.push_back(std::move(lines));
  reference_.reset();
}

}  // namespace edgevo
