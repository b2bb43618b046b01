// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/odometry/odometry.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "camera_log.h"
#include "edgevo/confidence/collect_evidence.h"
#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/stage_timer.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/core/trace.h"
#include "edgevo/edge_map/repeated_lines.h"
#include "edgevo/map/segment_join.h"
#include "odometry_impl.h"

namespace edgevo {
namespace {

TrackingParams tracking_params(const OdometryParams& p) {
  return {p.edges,
          p.alignment,
          p.status,
          p.health.confidence.step,
          p.mapping.corners,
          p.keyframe,
          p.recovery.bootstrap_out_of_view,
          p.camera.knows_rolling()};
}

// The least points in view are those of usual images.
OdometryParams for_size(OdometryParams p, const Pinhole& camera) {
  p.status = with_counts(p.status, [&](int count) { return count_for_size(count, camera); });
  return p;
}

MapperParams mapper_params(const OdometryParams& p) {
  return {p.mapping, p.association, p.camera, p.edge_map, {p.alignment, p.status}};
}

MapLinkOptions map_options(const OdometryOptions& o) {
  return {o.seed, o.realtime, o.on_schedule, o.detectors, o.move_map, o.forget, o.camera};
}

}  // namespace

// ---- one frame ----

Odometry::Impl::Impl(const Rectification& rectification, const OdometryParams& p, const OdometryOptions& o)
    : params(p),
      options(o),
      camera(rectification.camera().pinhole()),
      working(rectification.target()),
      state(p.recovery.max_frames, p.status),
      log(o.map_log ? o.map_log : std::make_shared<MapLog>()),
      frames(rectification, log, o.realtime),
      adjustments(log),
      confidence(p.health.confidence),
      scales(working, o.realtime),
      front_end(rectification, tracking_params(p), {o.seed, o.detectors, o.realtime && o.on_schedule},
                &history),
      map(rectification, p.edges, mapper_params(p), map_options(o), log),
      bootstrapper(rectification, tracking_params(p), p.mapping.bootstrap, o.seed, &map, &frames,
                   [this](Timestamp a, Timestamp b) { return front_end.gyro().turn(a, b); }) {
  front_end.set_correction(map.initial_camera().applied);
  if (p.health.corners) corners.emplace(), focal.emplace(front_end.rectification());
  if (o.forget) frames.forget();
  if (o.gyro) front_end.gyro() = GyroAid(*o.gyro);
  if (o.realtime && o.on_schedule)
    concurrent = std::make_unique<ConcurrentBootstrap>(rectification, tracking_params(p), p.mapping.bootstrap,
                                                       o.seed, &map);
}

FrameRecord Odometry::Impl::use(const Frame& frame, const ImageExposure& exposure) {
  publish_camera();
  follow_findings();
  if (concurrent) continue_with_map();
  const FrameRecord& record = waits_for_map() ? buffer_frame(frame, exposure) : follow(frame, exposure);
  if (!frame_published) frames.publish();
  record_newest_pose(record);
  for (const std::string& line : front_end.gyro().take_reports()) report(frame, line);
  frames.run();
  return record;
}

// What others have found since the frame before, whose pose stays.
void Odometry::Impl::follow_findings() {
  frames.run();
  if (state.has_map()) frames.follow_findings(state.segment());
}

const FrameRecord& Odometry::Impl::follow(const Frame& frame, const ImageExposure& exposure) {
  if (is_mapping_behind()) map.wait_keyframe();
  if (state.has_map()) change_reference(frame);
  front_end.begin_frame(frame.time);
  const ArrivedFrame arrived = find_edges(frame, state.has_pose(), exposure);
  if (state.tracks(arrived.record->evidence.edges, heading_sigma())) follow_map(arrived);
  if (state.has_pose() && newest_pose.T_cam_map) place_young_map(arrived);
  if (!state.has_pose()) track_features(arrived, std::nullopt);
  if (state.bootstraps()) bootstrap_map(arrived);
  return *arrived.record;
}

double Odometry::Impl::heading_sigma() const {
  const std::optional<CameraTurn> turn = front_end.heading();
  return turn ? std::sqrt(turn->covariance.trace() / 3) : std::numeric_limits<double>::infinity();
}

bool Odometry::Impl::is_mapping_behind() const {
  return front_end.postponed_keyframes() >= options.max_frames_ahead;
}

void Odometry::Impl::require_open(const std::string& where) const {
  if (is_closed) throw std::logic_error(where + ": the run has ended; make a new Odometry");
}

void Odometry::Impl::change_reference(const Frame& frame) {
  const std::shared_ptr<const Reference> newest = map.reference();
  const ImageCorrection before = front_end.correction();
  if (newest != front_end.reference() && newest->camera.applied != before) {
    const TraceScope traced("correction of the images");
    map.correct(&front_end.builder(), newest->camera.applied);
  }
  front_end.change_reference(newest);
  if (front_end.correction() == before) return;
  if (before.readout_s == 0 && front_end.correction().readout_s != 0) front_end.gyro().images_changed();
  forget_views();
  for (const std::string& line : describe_changes(before, newest->camera)) report(frame, line);
}

ArrivedFrame Odometry::Impl::find_edges(const Frame& frame, bool has_pose, const ImageExposure& exposure) {
  const TraceScope traced(name_of(Stage::kEdges));
  const double start = thread_cpu_ms();
  const std::shared_ptr<const FramePyramid> before = front_end.newest_pyramid();
  const bool had_mask = before && before->border_mask;
  ArrivedFrame arrived = front_end.find_edges(frame, has_pose, exposure);
  if (arrived.pyramid->border_mask && !had_mask)
    report(frame, describe_border_mask(arrived.pyramid->masked_share()));
  if (ego_mask_monitor.take(*arrived.pyramid)) {
    // Two views of a map would see different things.
    forget_views();
    replay.mask_changed();
    report(frame, ego_mask_monitor.description());
  }
  newest_pose = {};
  arrived.record = &frames.begin_frame(frame);
  frame_published = false;
  add_image(*arrived.pyramid, &arrived.record->evidence);
  arrived.record->evidence.fault = exposure.fault;
  if (arrived.pyramid->is_torn)
    report(frame, "the image is torn: the part that is of an earlier image is not used");
  arrived.record->stage_ms.emplace_back(name_of(Stage::kEdges), thread_cpu_ms() - start);
  return arrived;
}

// ---- tracking in a map ----

void Odometry::Impl::follow_map(ArrivedFrame now, bool is_replayed) {
  Track track = front_end.find_pose(&now, !state.has_pose());
  if (track.moving_objects > 0) report(now.frame, "a body moves by itself: no edges are taken from it");
  if (track.is_zero_velocity && !at_zero_velocity)
    report(now.frame, "the camera stands, its view is hidden: the pose is held");
  at_zero_velocity = track.is_zero_velocity;
  FrameStatus status = track.is_zero_velocity ? status_at_zero_velocity(now.record->evidence, params.status)
                                              : frame_status(now.record->evidence, params.status);
  status = status_with_refusal(status, front_end.step_gate(track.result.T_cur_ref));
  act(now.frame, state.after(event_of(status.state), now.frame.index), to_string(status.reasons));
  if (!state.has_pose()) {
    assign_status({TrackingState::kLost, status.reasons}, now.record);
    history.interrupt();
    zoom_change.interrupt();
    integrity.add_lost();
    keep_views_before();
    return;
  }
  if (!is_replayed) update_coverage_and_features(now, track.result.T_cur_ref);
  record_pose(track.result, now.record, is_replayed);
  ImageZoom zoom = track.result.zoom;
  zoom.sigma *= std::sqrt(front_end.reference()->error_factor);
  TrackedFrame tracked = front_end.accept_pose(now, std::move(track), map.is_keyframe_pending());
  assign_confidence(status, zoom, now.record);
  if (focal) tracked.focal_length = focal->error();
  watch_integrity(now, &tracked);
  // Whoever follows the events knows a frame before the keyframe that mapping makes of it.
  if (is_replayed) {
    frames.place(*now.record, state.segment(), *front_end.reference(), tracked.T_cam_ref);
  } else {
    frames.publish();
    frame_published = true;
  }
  map.submit(std::move(tracked));
}

void Odometry::Impl::update_coverage_and_features(const ArrivedFrame& now, const SE3& T_cur_ref) {
  if (const std::optional<Event> seen = event_of(front_end.look(now.record->evidence)))
    act(now.frame, state.after(*seen, now.frame.index));
  track_features(now, front_end.motion_to(T_cur_ref), T_cur_ref * front_end.reference()->T_ref_world);
}

void Odometry::Impl::track_features(const ArrivedFrame& now, const std::optional<SE3>& T_cur_last,
                                    const std::optional<SE3>& T_cam_map) {
  if (!corners) return;
  const StageTimer timer(Stage::kFeatureTracking, &now.record->stage_ms);
  const MovingAreas moving = front_end.moving_areas();
  FrameEvidence& evidence = now.record->evidence;
  evidence.corners = corners->add(
      now.pyramid, T_cur_last, [&](const Eigen::Vector2d& px) { return moving.cover(px); }, evidence.stands,
      T_cam_map);
  focal->add(corners->followed(), T_cur_last, now.pyramid->correction);
  if (const std::optional<FocalError> found = focal->error()) {
    const double in_use = 1 + now.pyramid->correction.focal;
    evidence.focal_error = (1 + found->value) / in_use - 1;
    evidence.focal_error_sigma = found->sigma / in_use;
  }
}

void Odometry::Impl::record_pose(const TrackResult& tracked, FrameRecord* record, bool is_replayed) {
  const Reference& reference = *front_end.reference();
  record->covariance = reported_covariance(tracked, reference);
  if (!is_replayed) frames.place(state.segment(), reference, tracked.T_cur_ref);
  newest_pose.T_cam_map = tracked.T_cur_ref * reference.T_ref_world;
}

void Odometry::Impl::assign_confidence(const FrameStatus& by_image, const ImageZoom& zoom,
                                       FrameRecord* record) {
  for (const std::shared_ptr<const MapEvent>& event : adjustments.read())
    if (const auto* mapped = std::get_if<FrameMapped>(event.get()); mapped && mapped->adjustment)
      confidence.add_adjustment(*mapped->adjustment);
  record->evidence.moved_by_map = history.newest().moved_by_map / record->evidence.median_depth;
  const FrameConfidence found = confidence.add({record->evidence, history.newest(), zoom_change.add(zoom)});
  record->p_right = found.p_right;
  unit_sigma = found.unit_sigma;
  assign_status(frame_status(by_image, found), record);
  record->covariance *= covariance_factor(found.p_right);
  if (!is_map_in_doubt(*record)) front_end.confirm_turn();
  if (p_right(found.doubts) >= kDoubtfulBelow) front_end.believe_gyro();
}

// ---- doubt ----

void Odometry::Impl::watch_integrity(const ArrivedFrame& now, TrackedFrame* tracked) {
  const TrustedReference view{now.frame.index, state.segment(), front_end.reference()};
  const IntegrityMonitor::Integrity found =
      integrity.add(now.frame.index, view, is_map_in_doubt(*now.record) || unit_sigma > kUnitKnown);
  tracked->is_in_doubt = found == IntegrityMonitor::Integrity::kInDoubt;
  if (tracked->is_in_doubt) keep_views_before();
  scales.begin(found, now.frame.index, view, integrity.before(), [&](const TrustedReference& v) {
    return frames.scale_of(v.segment, v.reference->keyframe_id);
  });
  if (const std::optional<ScaleAnswer> answer = scales.take(found, view)) {
    keep_links(*answer);
    report_links(now, *answer);
    tracked->confirms_map = answer->confirms_map;
  }
}

void Odometry::Impl::keep_views_before() {
  for (const TrustedReference& view : integrity.before()) frames.keep(view.reference->keyframe_id);
}

// What links the map to a view before several doubts relates all epochs since.
void Odometry::Impl::keep_links(const ScaleAnswer& answer) {
  bool is_new = answer.begins_epoch();
  if (is_new)
    frames.begin_epoch(
        {answer.now.segment, answer.last_before->reference->keyframe_id, answer.now.reference->keyframe_id},
        answer.last_before->frame_index, answer.frame_index);
  for (const ComparedScale& c : answer.compared) {
    if (!c.found.linked) continue;
    const auto& [before, link] = *c.found.linked;
    frames.add_constraint(
        constraint_of({link.T_b_a, link.scale, link.sigma}, *before.reference, *answer.now.reference));
    is_new = true;
    if (c.is_open) frames.constrain_scale(answer.now.segment, *c.found.unit);
  }
  if (is_new) frames.place_epochs(state.segment());
}

void Odometry::Impl::report_links(const ArrivedFrame& now, const ScaleAnswer& answer) {
  const std::optional<RelativeScale>& unit = answer.found().unit;
  const bool is_of_this_map = answer.now.segment == state.segment();
  if (answer.ends_doubt && is_of_this_map) now.record->evidence.unit = unit;
  if (!unit || !(answer.ends_doubt || unit->is_linked())) return;
  const char* what = answer.ends_doubt ? "sure again; " : "the view before the doubt is seen again; ";
  report(now.frame, what + in_words(*unit));
}

// ---- state and records ----

void Odometry::Impl::publish_camera() {
  if (!std::exchange(camera_published, true)) log->append(CameraEstimated{map.initial_camera()});
}

void Odometry::Impl::act(const Frame& frame, Action action, const std::string& reason) {
  if (action == Action::kLose || action == Action::kBeginBootstrap || action == Action::kDropBootstrap)
    forget_views(), replay.clear();
  if (action == Action::kLose) report(frame, "LOST: " + reason);
  if (action == Action::kRelocalised) replay.clear(), report(frame, "relocalised in the old map");
}

void Odometry::Impl::record_newest_pose(const FrameRecord& record) {
  newest_pose.frame_index = record.index;
  newest_pose.time = record.time;
  newest_pose.state = record.state;
  newest_pose.note = record.note;
  newest_pose.p_right = record.p_right;
  newest_pose.segment = state.has_map() ? state.segment() : -1;
  const Sim3 T_odom_map = state.has_map() ? frames.T_odom_map(state.segment()) : Sim3();
  newest_pose.T_odom_map = T_odom_map.rigid;
  newest_pose.odom_scale = T_odom_map.scale;
  const WorldOfOdometry& world = frames.world_of_odometry();
  newest_pose.T_world_odom = world.T_world_odom;
  newest_pose.world_changes = world.changes;
  newest_pose.scale_sigma = world.scale_sigma;
  newest_pose.heading.reset();
  if (state.has_map() && !newest_pose.T_cam_map && !waits_for_map())
    if (const std::optional<CameraTurn> turn = front_end.heading())
      newest_pose.heading = {turn->R, turn->covariance};
  newest_pose.reference = state.has_map() ? front_end.reference() : nullptr;
  newest_pose.covariance = record.covariance;
}

void Odometry::Impl::close() {
  require_open("Odometry::close()");
  is_closed = true;
  publish_camera();
  if (concurrent) replay_at_end();
  skipped_work = map.finish();
  front_end.drop_map();
}

Run Odometry::Impl::finish() {
  if (is_finished) throw std::logic_error("Odometry::finish(): the run has ended; make a new Odometry");
  is_finished = true;
  if (!is_closed) close();
  Run run = frames.run().finish();
  merge_repeated_lines(run.pinhole, params.edge_map, &run.keyframes);
  if (options.realtime) run.realtime = skipped_work;
  return run;
}

FrameView Odometry::Impl::frame_view() const {
  if (!state.has_pose() || !front_end.reference() || waits_for_map())
    return {front_end.newest_pyramid(), {}, -1};
  // From the segment's map to the frame of live poses lengths are multiplied by the scale.
  return front_end.view(1.0 / frames.T_odom_map(state.segment()).scale);
}

void Odometry::Impl::report(const Frame& frame, const std::string& what) const {
  if (options.log) options.log("frame " + std::to_string(frame.index) + ": " + what);
}

Rectification rectification_of(const Camera& camera, const OdometryOptions& options) {
  return rectification_of(camera, options.working_pinhole);
}

Odometry::Odometry(const Camera& camera, const OdometryParams& params, const OdometryOptions& options)
    : impl_(std::make_unique<Impl>(rectification_of(camera, options),
                                   for_size(params, rectification_of(camera, options).target()), options)) {}
Odometry::~Odometry() = default;

void Odometry::add_gyro(const GyroSample& sample) { impl_->front_end.add(sample); }
GyroState Odometry::gyro() const {
  const GyroAid& gyro = impl_->front_end.gyro();
  return {gyro.statement(), gyro.model() ? std::make_shared<const GyroModel>(*gyro.model()) : nullptr};
}
FrameRecord Odometry::process(const Frame& frame) { return impl_->process(frame); }
FrameView Odometry::frame_view() const { return impl_->frame_view(); }
std::shared_ptr<const Plane<uint8_t>> Odometry::ego_mask() const {
  const std::shared_ptr<const FramePyramid>& newest = impl_->front_end.newest_pyramid();
  return newest ? newest->ego_mask : nullptr;
}
SE3 T_odom_cam(const NewestPose& view, const SE3& T_cam_map) {
  return Sim3{view.odom_scale, view.T_odom_map}.apply(T_cam_map.inverse());
}

const NewestPose& Odometry::newest_pose() const { return impl_->newest_pose; }
FrameRecord Odometry::skip(const Frame& frame, const std::string& why) { return impl_->skip(frame, why); }
void Odometry::shed(Shedding shedding) { impl_->map.shed(shedding); }
void Odometry::close() { impl_->close(); }
Run Odometry::finish() { return impl_->finish(); }

}  // namespace edgevo
