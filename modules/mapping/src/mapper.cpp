// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/mapper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/stage_timer.h"
#include "edgevo/core/trace.h"
#include "first_keyframes.h"
#include "rebuilt_images.h"

namespace edgevo {
namespace {

// Fewest points of the first window: fewer do not constrain its poses against outliers.
constexpr int kMinFirstPoints = 100;
constexpr int kMaxAgeKeyframes = 4;  // immature points older than this are dropped

AdjustmentEvidence evidence_of(const WindowStats& stats) {
  AdjustmentEvidence evidence;
  evidence.cost_per_match = stats.cost_per_observation;
  evidence.matches = stats.observations;
  evidence.points = stats.points;
  evidence.matches_in_newest = stats.matched_in_newest;
  evidence.unit_variance = stats.unit_variance;
  return evidence;
}

}  // namespace

Mapper::Mapper(const Rectification& rectification, const MapperParams& params, const MapperOptions& options)
    : rectification_(rectification),
      pinhole_(rectification.target()),
      cells_(rectification, params.mapping.depth_filter.cell_px),
      params_(params.mapping),
      association_(params.association),
      gradient_patches_(params.tracking.alignment.photometric),
      options_(options),
      random_(Random::derive(options.seed, 2)),
      log_(options.log ? options.log : std::make_shared<MapLog>()),
      map_(std::make_unique<Map>(rectification, log_)),
      window_(map_.get(), rectification, params.mapping.window, params.association),
      calibration_(rectification, params.camera),
      edge_mapper_(rectification, params.edge_map, params.tracking, options.own_threads, log_),
      corrected_images_(std::make_unique<RebuiltImages>(options.rebuild)) {
  if (options.camera) calibration_.begin_with(*options.camera);
}
Mapper::~Mapper() = default;

// ---- the first window ----

Reasons Mapper::initialise(const BootstrapResult& bootstrap) {
  const TraceScope traced("first window");
  window_ = Window(map_.get(), rectification_, params_.window, association_);
  tracking_check_ = {};
  add_first_keyframes(bootstrap);
  filter_first_depths(bootstrap);
  smooth_depths();
  window_.fix_bootstrap_scale();
  window_.activate({1, 1});
  window_.adjust();
  const WindowStats stats = window_.adjust();
  if (stats.points < count_for_size(kMinFirstPoints, rectification_.target())) {
    map_->discard();
    return {{ReasonKind::kFewPointsMatched, double(stats.points)}};
  }
  next_id_ += int(window_.keyframes().size());
  seen_idepths_ = {1 / kFirstMedianDepth, 0};
  publish(window_.newest());
  return {};
}

void Mapper::add_first_keyframes(const BootstrapResult& bootstrap) {
  const std::vector<const BootstrapView*> chosen = choose_keyframe_views(bootstrap.views);
  for (const BootstrapView* view : chosen) {
    Keyframe k;
    k.id = next_id_ + int(window_.keyframes().size());
    k.frame_index = view->frame_index;
    k.time = view->time;
    k.pyramid = view->pyramid;
    k.motion = view->motion;
    k.T_cam_world = view->T_cam_first;
    if (view == chosen.front() || view == chosen.back())
      k.immature = first_points(k, bootstrap.corners, view == chosen.back());
    window_.add(std::move(k));
  }
}

// Each view of the bootstrap observes the points of all keyframes except its own.
void Mapper::filter_first_depths(const BootstrapResult& bootstrap) {
  for (const BootstrapView& view : bootstrap.views) {
    if (!view.placed || !view.pyramid) continue;
    for (Keyframe& k : window_.keyframes())
      if (view.frame_index != k.frame_index)
        update_depths(*view.pyramid, view.T_cam_first * k.T_cam_world.inverse(), params_.depth_filter, &k);
  }
}

void Mapper::smooth_depths() {
  for (Keyframe& host : window_.keyframes())
    smooth_along_edges(host.pyramid->finest().edges, params_.depth_filter, &host.immature);
}

std::vector<ImmaturePoint> Mapper::first_points(const Keyframe& keyframe,
                                                const std::vector<BootstrapCorner>& corners, bool is_last) {
  return make_immature_points(
      keyframe, cells_, std::vector<bool>(cells_.size(), false),
      [&](const Eigen::Vector2d& px) { return range_near(corners, is_last, px); }, params_.depth_filter,
      &random_);
}

// ---- a frame ----

MapUpdate Mapper::process(const TrackedFrame& tracked) {
  MapUpdate update;
  // With images of the camera before, only a keyframe, or the end of a doubt, is worth new ones.
  const bool is_outdated = !(tracked.pyramid->correction == calibration_.state().applied);
  if (is_outdated && options_.own_threads && !tracked.is_needed() && tracked.return_to < 0) return update;
  const TrackedFrame frame = corrected(with_corners(tracked, &update.times));
  const auto& known = reference_->T_keyframe_world;
  const auto reference_pose = known.find(frame.reference_id);
  // The frame's reference may have left the window meanwhile (two threads): such a frame comes too late to
  // help.
  if (reference_pose == known.end()) {
    if (frame.confirms_map) confirm();
    return update;
  }
  const SE3 T_cam_world = frame.T_cam_ref * reference_pose->second;
  if (frame.is_in_doubt) note_doubt(frame);
  if (frame.focal_length) calibration_.note_focal_length(*frame.focal_length);
  drop_moving_points(frame, T_cam_world);
  filter_depths(frame, T_cam_world, &update.times);
  if (!frame.make_keyframe) show_edges(frame, &update.times);
  if (frame.make_keyframe)
    make_keyframe(frame, T_cam_world, &update);
  else if (frame.return_to >= 0)
    return_to(frame.return_to, &update.times);
  else
    correct_between_keyframes(&update.times);
  if (frame.confirms_map) confirm();
  return update;
}

TrackedFrame Mapper::with_corners(TrackedFrame frame, StageTimes* times) {
  if (!frame.by_corners.valid()) return frame;
  const TraceScope traced("wait for corners");
  PoseByCorners found = frame.by_corners.get();
  times->emplace_back(name_of(Stage::kCorners), found.cpu_ms);
  frame.T_cam_ref = found.T_cam_ref;
  frame.covariance = found.covariance;
  frame.corners = std::move(found.corners);
  return frame;
}

// A frame that was queued while the camera was corrected gets images with the new correction, and loses its
// corners, which were measured in the old ones.
TrackedFrame Mapper::corrected(const TrackedFrame& tracked) const {
  TrackedFrame frame = tracked;
  const ImageCorrection now = calibration_.state().applied;
  if (tracked.pyramid->correction == now) return frame;
  frame.pyramid = options_.rebuild(*tracked.pyramid, tracked.motion, now);
  frame.corners.clear();
  return frame;
}

// Points of the map stay until a keyframe comes, as do the matches that the adjustment has of them.
void Mapper::drop_moving_points(const TrackedFrame& frame, const SE3& T_cam_world) {
  moving_ = frame.moving;
  if (moving_.empty()) return;
  for (Keyframe& host : window_.keyframes()) {
    const SE3 T_cam_host = T_cam_world * host.T_cam_world.inverse();
    const Eigen::Matrix3d R = T_cam_host.R();
    const auto is_covered = [&](const auto& p) {
      const Projection seen = project(pinhole_, R, T_cam_host.translation(), pinhole_.ray(p.px), p.idepth);
      return seen.valid && moving_.cover(seen.px);
    };
    for (ImmaturePoint& p : host.immature) p.dead |= is_covered(p);
    if (!frame.make_keyframe) continue;
    host.points.erase(std::remove_if(host.points.begin(), host.points.end(),
                                     [&](const MapPoint& p) {
                                       return moving_.made(host.id, p.edge_pixel) || is_covered(p);
                                     }),
                      host.points.end());
  }
}

void Mapper::filter_depths(const TrackedFrame& frame, const SE3& T_cam_world, StageTimes* times) {
  const StageTimer timer(Stage::kDepthFilter, times);
  for (Keyframe& host : window_.keyframes())
    if (!host.immature.empty())
      update_depths(*frame.pyramid, T_cam_world * host.T_cam_world.inverse(), params_.depth_filter, &host);
}

// The camera is back near an older keyframe: the next frames are tracked against that one and do not drift
// away from it.
void Mapper::return_to(int keyframe_id, StageTimes* times) {
  const StageTimer timer(Stage::kWindow, times);
  const auto& keyframes = window_.keyframes();
  const auto old = std::find_if(keyframes.begin(), keyframes.end(),
                                [&](const Keyframe& k) { return k.id == keyframe_id; });
  if (old != keyframes.end() && keyframe_id != reference_->keyframe_id) publish(*old);
}

// ---- a keyframe ----

void Mapper::make_keyframe(const TrackedFrame& frame, const SE3& T_cam_world, MapUpdate* update) {
  StageTimes* times = &update->times;
  add_keyframe(frame, T_cam_world);
  update->keyframe_id = window_.newest().id;
  associate(frame, times);
  activate_points(times);
  update->stats = adjust(times);
  // A failed adjustment has moved nothing.
  if (update->stats.points > 0) {
    update->adjustment = evidence_of(update->stats);
    update->adjustment->moved = check_tracking(frame);
  }
  if (window_.full()) {
    remove_oldest(times);
    map_edges(times);
  }
  calibrate_if_due(times);
  move_if_proposed();
  evict();
  seed_and_publish(times);
  map_->announce_window();
}

void Mapper::add_keyframe(const TrackedFrame& frame, const SE3& T_cam_world) {
  Keyframe keyframe;
  keyframe.id = next_id_++;
  keyframe.frame_index = frame.frame_index;
  keyframe.time = frame.time;
  keyframe.pyramid = frame.pyramid;
  keyframe.motion = frame.motion;
  keyframe.is_doubtful = frame.is_in_doubt;
  keyframe.T_cam_world = T_cam_world;
  if (!frame.corners.empty()) {
    keyframe.corners_from = frame.reference_id;
    keyframe.corners = frame.corners;
  }
  keyframe.turn = frame.turn;
  window_.add(std::move(keyframe));
}

void Mapper::associate(const TrackedFrame& frame, StageTimes* times) {
  const StageTimer timer(Stage::kAssociation, times);
  window_.associate_newest(frame.covariance);
}

void Mapper::activate_points(StageTimes* times) {
  const StageTimer timer(Stage::kActivation, times);
  smooth_depths();
  window_.demote_unconfirmed();
  ActivationPolicy policy{2, params_.window.min_matches};
  if (shedding_ >= Shedding::kPoints) {
    policy.budget = std::max(0, params_.window.max_points / 2 - window_.active_points());
    ++shed_work_.points;
  }
  window_.activate(policy);
  // Large motion leaves the map behind before points are seen often: then one depth and one match must do.
  // Candidates that the first pass has tried, with two depths, are not tried again.
  if (params_.window.use_tentative_points) window_.activate({1, 1, window_.points_lacking()});
}

WindowStats Mapper::adjust(StageTimes* times) {
  const StageTimer timer(Stage::kBundleAdjustment, times);
  return window_.adjust();
}

// Compares the tracked pose of the newest keyframe with the adjusted one. Returns how far that was moved; NaN
// if its reference has left the window.
double Mapper::check_tracking(const TrackedFrame& frame) {
  for (const Keyframe& k : window_.keyframes())
    if (k.id == frame.reference_id)
      return tracking_check_.add(frame.T_cam_ref, relative_pose(window_.newest(), k), frame.covariance);
  return std::numeric_limits<double>::quiet_NaN();
}

void Mapper::remove_oldest(StageTimes* times) {
  const StageTimer timer(Stage::kWindow, times);
  window_.remove_oldest();
}

// Maps the lines of the keyframe that has just left the window.
void Mapper::map_edges(StageTimes* times) {
  const StageTimer timer(Stage::kEdgeMap, times);
  // A correction that waits for the lines of the keyframes before gets no more of them.
  if (shedding_ >= Shedding::kLines || keyframes_prepared_ > 0)
    ++shed_work_.lines;
  else
    edge_mapper_.add(*map_);
}

// Lines need views of what is near, which keyframes alone pass by.
void Mapper::show_edges(const TrackedFrame& frame, StageTimes* times) {
  if (shedding_ >= Shedding::kLines || frame.is_in_doubt) return;
  const StageTimer timer(Stage::kEdgeMap, times);
  edge_mapper_.add_view(frame.reference_id, frame.T_cam_ref, *frame.pyramid);
}

// Drops what no later step needs of marginalised keyframes.
void Mapper::evict() {
  const size_t needed = edge_mapper_.keyframes_needed();
  map_->evict_images(needed);
  if (!calibration_.needs_matches()) map_->evict_matches(needed);
  if (options_.forget) map_->evict_records();
}

void Mapper::seed_and_publish(StageTimes* times) {
  const StageTimer timer(Stage::kWindow, times);
  drop_old_points();
  seed_points(&window_.newest());
  publish(window_.newest());
}

// ---- new points, and the reference for tracking ----

// Every immature point is searched in every frame: no more than it takes to fill the window again.
int Mapper::new_points_wanted() const {
  constexpr int kAtLeast = 300;  // points per keyframe: even a full window needs some where the view is new
  const DepthFilterParams& p = params_.depth_filter;
  if (shedding_ >= Shedding::kPoints) return std::min(kAtLeast, p.max_new_points);
  const int lacking = std::max(0, params_.window.max_points - window_.active_points());
  return std::clamp(int(std::lround(p.candidates_per_point * lacking)), std::min(kAtLeast, p.max_new_points),
                    p.max_new_points);
}

// Drops immature points that are dead, or have been immature for too long.
void Mapper::drop_old_points() {
  for (Keyframe& host : window_.keyframes()) {
    auto& points = host.immature;
    for (ImmaturePoint& p : points) p.dead |= ++p.age > kMaxAgeKeyframes;
    points.erase(std::remove_if(points.begin(), points.end(), [](const ImmaturePoint& p) { return p.dead; }),
                 points.end());
  }
}

// Adds immature points to a keyframe where the map has none. Points that were passed on to it, the only ones
// that it hosts by now, do not count: those stay in view for long since they are far away, and would keep
// nearer ones out.
void Mapper::seed_points(Keyframe* keyframe) {
  IdepthPrior prior(cells_, params_.depth_filter, seen_idepths_);
  for (const CloudPoint& p : window_.cloud(*keyframe))
    if (p.host_keyframe != keyframe->id) prior.add(p.px.cast<double>(), p.idepth);
  seen_idepths_ = prior.seen();
  std::vector<bool> occupied(cells_.size());
  for (int c = 0; c < cells_.size(); ++c) occupied[c] = prior.occupied(c) || moving_.cover(cells_.centre(c));
  DepthFilterParams wanted = params_.depth_filter;
  wanted.max_new_points = new_points_wanted();
  keyframe->immature = make_immature_points(
      *keyframe, cells_, occupied, [&](const Eigen::Vector2d& px) { return prior.range(px); }, wanted,
      &random_);
}

void Mapper::publish(const Keyframe& keyframe) {
  auto reference = std::make_shared<Reference>();
  reference->keyframe_id = keyframe.id;
  reference->time = keyframe.time;
  reference->T_ref_world = keyframe.T_cam_world;
  reference->camera = calibration_.state();
  reference->moves = map_->moves();
  reference->cloud =
      make_reference_cloud(keyframe.pyramid, window_.tracking_cloud(keyframe), gradient_patches_);
  reference->known_points = int(window_.cloud(keyframe).size());
  reference->wanted_points = window_.points_wanted();
  reference->view_share = window_.view_share(keyframe);
  reference->median_idepth = seen_idepths_.median;
  reference->error_factor = tracking_check_.error_factor();
  for (const Keyframe& k : window_.keyframes()) reference->T_keyframe_world[k.id] = k.T_cam_world;
  reference_ = std::move(reference);
}

void Mapper::close() {
  corrected_images_->finish();
  if (calibration_.is_focal_length_due(*map_)) calibrate(true);
  if (!window_.keyframes().empty()) calibrate(true);
  corrected_images_->clear();
  keyframes_prepared_ = 0;
  calibration_.cancel();
  while (!window_.keyframes().empty()) {
    window_.release_oldest();
    edge_mapper_.add(*map_);
    evict();
  }
  edge_mapper_.close();
  map_->end_segment();
  reference_.reset();
}

}  // namespace edgevo
