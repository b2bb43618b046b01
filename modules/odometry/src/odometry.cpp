#include "edgevo/odometry/odometry.h"

#include "bootstrap_placement.h"
#include "camera_log.h"
#include "edgevo/core/rule.h"
#include "edgevo/core/thread_clock.h"
#include "frame_tracker.h"
#include "keyframe_policy.h"
#include "map_coverage.h"
#include "mapping_thread.h"
#include "motion_model.h"
#include "run_records.h"
#include "see_points.h"
#include "state_machine.h"

namespace edgevo {
struct Odometry::Impl {
  Impl(const Camera& camera, const OdometryParams& p, const OdometryOptions& o)
      : params(p),
        options(o),
        builder(camera, p.edges, o.detectors),
        bootstrap(camera.pinhole, p.mapping.bootstrap, o.seed),
        random(Random::derive(o.seed, 3)),
        mapper(camera.pinhole, p.mapping, p.association, p.alignment.photometric, o.seed),
        records(camera.pinhole),
        rebuilder(PyramidBuilder::for_rebuilding(camera, p.edges, o.detectors)),
        state(p.recovery.max_frames),
        mapping(&mapper, o.realtime,
                [this](const TrackedFrame& f, const MapUpdate& u) { note_update(f, u); }),
        keyframes(camera.pinhole, p.keyframe) {
    // In realtime the mapping must not stand still for long.
    mapper.enable_self_calibration(
        p.camera,
        [this](const FramePyramid& old, const ImageMotion& motion, const ImageCorrection& now) {
          rebuilder.set_correction(now);
          return rebuilder.rebuild(old, motion);
        },
        o.realtime);
    mapper.enable_edge_map(p.edge_map, o.realtime);
    builder.set_correction(mapper.camera().correction());
  }

  // ---- one frame ----

  /// A frame on its way.
  struct Arrival {
    const Frame& frame;
    std::shared_ptr<const FramePyramid> pyramid;
    RowRectification rows;
    FrameRecord* record;
  };

  const FrameRecord& process(const Frame& frame) {
    if (keyframes.postponed() >= options.max_frames_ahead) mapping.wait_keyframe();
    if (state.has_map()) change_reference(frame, mapping.reference());
    motion.begin_frame(frame.time);
    const Arrival arrival = find_edges(frame);
    if (state.tracks(arrival.record->edges)) follow_map(arrival);
    if (state.bootstraps()) bootstrap_map(arrival);
    note_pose(*arrival.record);
    return *arrival.record;
  }

  // The motion model bridges the gap, as it does after frames that were lost.
  const FrameRecord& pass_over(const Frame& frame, const std::string& why) {
    FrameRecord& record = records.begin_frame(frame);
    record.state = state.passed_over();
    record.note = why;
    motion.begin_frame(frame.time);
    return record;
  }

  Arrival find_edges(const Frame& frame) {
    const double start = thread_cpu_ms();
    const RowRectification rows{builder.correction().readout_s, expected_motion()};
    const std::shared_ptr<const FramePyramid> pyramid =
        builder.build(frame, rows.expected);  // throws for a wrong size: no record then
    if (pyramid->border_mask && !(newest_pyramid && newest_pyramid->border_mask))
      say(frame, describe_border_mask(pyramid->masked_share()));
    newest_pyramid = pyramid;
    newest_pose = {};
    FrameRecord& record = records.begin_frame(frame);
    record.stage_ms.emplace_back("edges", thread_cpu_ms() - start);
    record.edges = int(pyramid->finest().edges.pixels.size());
    return {frame, pyramid, rows, &record};
  }

  // What the rows of the next image are rectified for: the camera goes on as before.
  ImageMotion expected_motion() const {
    const std::optional<Vector6d> twist = motion.expected_twist();
    if (builder.correction().readout_s == 0 || !state.has_pose() || !twist) return {};
    return image_motion(builder.pinhole(), reference->cloud, motion.predict(), *twist,
                        reference->median_idepth);
  }

  // ---- a map to follow ----

  void follow_map(const Arrival& now) {
    Track track = find_pose(now);
    act(now.frame, state.after(event_of(track.result.verdict), now.frame.index), track.result.reason);
    if (!state.has_pose()) {
      now.record->state = TrackingState::kLost;
      return;
    }
    if (const std::optional<Event> seen = coverage.look(*reference, track.result))
      act(now.frame, state.after(*seen, now.frame.index));
    const SE3& T_cur_ref = track.result.T_cur_ref;
    now.record->state = track.result.verdict;
    now.record->covariance = reference->error_factor * track.result.covariance;
    records.place(now.record, state.segment(), reference->keyframe_id, T_cur_ref, reference->T_ref_world);
    newest_pose.T_cam_map = T_cur_ref * reference->T_ref_world;
    motion.follow(T_cur_ref, track.took_usual_step);
    const KeyframeDecision decision = keyframes.decide(track.result, *reference, mapping.keyframe_pending());
    mapping.submit(tracked_frame(now, std::move(track), decision));
  }

  Track find_pose(const Arrival& now) {
    const double start = thread_cpu_ms();
    Track track = track_frame(
        {*now.pyramid, *reference, motion, keyframes, params, now.rows, !state.has_pose(), &random});
    FrameRecord& record = *now.record;
    record.stage_ms.emplace_back("alignment", thread_cpu_ms() - start - track.corner_ms);
    if (track.corner_ms > 0) record.stage_ms.emplace_back("corners", track.corner_ms);
    record.inlier_share = track.result.evidence.inlier_share;
    record.residual_px = track.result.stats.residual_px;
    record.note = track.result.reason;
    return track;
  }

  // What the mapping gets.
  TrackedFrame tracked_frame(const Arrival& now, Track track, const KeyframeDecision& decision) {
    TrackedFrame tracked;
    tracked.frame_index = now.frame.index;
    tracked.time = now.frame.time;
    tracked.pyramid = now.pyramid;
    tracked.reference_id = reference->keyframe_id;
    tracked.T_cam_ref = track.result.T_cur_ref;
    tracked.covariance = track.result.covariance;
    tracked.corners = std::move(track.corners);
    tracked.return_to = decision.return_to;
    tracked.make_keyframe = decision.action == KeyframeDecision::Action::kMake;
    now.record->keyframe_rule = decision.rule;
    if (tracked.make_keyframe && params.camera.knows_rolling() && rule("rolling shutter"))
      rectify_keyframe(now, track.twist, &tracked);
    return tracked;
  }

  // What is measured in a keyframe stays: its rows are rectified again, for the motion that was found.
  void rectify_keyframe(const Arrival& now, const Vector6d& twist, TrackedFrame* tracked) {
    const double start = thread_cpu_ms();
    tracked->motion = measured_motion(builder.pinhole(), *reference, now.rows, tracked->T_cam_ref, twist);
    if (now.rows.is_rolling()) {
      tracked->pyramid = builder.rebuild(*now.pyramid, tracked->motion);
      for (CornerPair& c : tracked->corners)
        c.to = shift_ray(builder.pinhole(), now.rows.readout_s, now.rows.expected, tracked->motion, c.to);
    }
    now.record->stage_ms.front().second += thread_cpu_ms() - start;  // the edges
  }

  // Another keyframe became the reference: the last pose is re-expressed against it.
  void change_reference(const Frame& frame, std::shared_ptr<const Reference> newest) {
    if (newest == reference) return;
    if (newest->camera.correction() != builder.correction()) change_camera(frame, newest->camera);
    if (reference) {
      const auto old = newest->T_keyframe_world.find(reference->keyframe_id);
      const SE3 T_old_world = old != newest->T_keyframe_world.end() ? old->second : reference->T_ref_world;
      motion.change_reference(T_old_world * newest->T_ref_world.inverse());
    }
    reference = std::move(newest);
  }

  // Self-calibration has corrected the map: the images that follow are corrected alike.
  void change_camera(const Frame& frame, const CameraRefinement& camera) {
    const ImageCorrection before = builder.correction();
    builder.set_correction(camera.correction());
    bootstrap.reset();
    for (const std::string& line : describe_changes(before, camera)) say(frame, line);
  }

  // ---- a map to be made ----

  void bootstrap_map(const Arrival& now) {
    const double start = thread_cpu_ms();
    BootstrapStatus status = bootstrap.add(now.frame.index, now.frame.time, now.pyramid);
    if (status.result) status.reason = make_map(now, *status.result);
    FrameRecord& record = *now.record;
    record.stage_ms.emplace_back("bootstrap", thread_cpu_ms() - start);
    if (record.T_world_cam_live) return;
    record.state = state.without_pose(record.index, record.edges);
    record.note = (record.note.empty() ? "" : record.note + "; ") + status.reason;
  }

  // A new segment; an empty string, or why the two views make no map.
  std::string make_map(const Arrival& now, const BootstrapResult& views) {
    mapping.wait_idle();
    // Beside a map that is still tracked the scale of the new one follows from the depths in view, else from
    // equal speed.
    std::optional<double> scale;
    if (state.has_pose()) scale = 1.0 / reference->median_idepth / params.mapping.bootstrap.median_depth;
    if (state.has_map()) close_segment();
    const std::string problem = mapper.initialise(views);
    bootstrap.reset();
    state.after(problem.empty() ? Event::kMapMade : Event::kMapRefused, now.frame.index);
    if (problem.empty()) begin_segment(now, views, scale);
    return problem;
  }

  void begin_segment(const Arrival& now, const BootstrapResult& views, std::optional<double> scale) {
    mapping.refresh();
    reference = mapping.reference();
    records.begin_segment(state.segment(), views, scale);
    note_window();
    place_bootstrap_frames(views, *reference, state.segment(), params.alignment, &records);
    newest_pose.T_cam_map = reference->T_ref_world;
    const std::optional<SE3> before = records.pose_before(now.frame.index, state.segment());
    motion.restart(before ? std::optional<SE3>(reference->T_ref_world * before->inverse()) : std::nullopt);
    keyframes.restart();
    coverage.restart();
    now.record->note.clear();
    say(now.frame, "map of " + std::to_string(reference->cloud.points.size()) + " edge points, segment " +
                       std::to_string(state.segment()));
  }

  void close_segment() {
    mapper.close();
    take_settled();
    note_window();
    reference.reset();
  }

  // Keyframes that have left the window, and what the camera's correction moved.
  void take_settled() {
    records.retire(mapper.take_retired(), state.segment());
    records.set_lines(mapper.take_lines());
    records.revise(mapper.take_revised());
  }

  void note_window() { records.note_window(mapper.window().keyframes(), state.segment()); }

  // ---- state and records ----

  void act(const Frame& frame, Action action, const std::string& reason = {}) {
    if (action == Action::kLose || action == Action::kBeginBootstrap || action == Action::kDropBootstrap)
      bootstrap.reset();
    if (action == Action::kLose) say(frame, "LOST: " + reason);
    if (action == Action::kRelocalised) say(frame, "relocalised in the old map");
  }

  void note_pose(const FrameRecord& record) {
    newest_pose.frame_index = record.index;
    newest_pose.time = record.time;
    newest_pose.state = record.state;
    newest_pose.note = record.note;
    newest_pose.segment = state.has_map() ? state.segment() : -1;
    newest_pose.reference = state.has_map() ? reference : nullptr;
    newest_pose.covariance = record.covariance;
  }

  // Called by the mapping thread.
  void note_update(const TrackedFrame& frame, const MapUpdate& update) {
    records.note_mapping(frame.frame_index, update);
    take_settled();
    if (update.keyframe_id >= 0) note_window();
  }

  Run finish() {
    mapping.wait_idle();
    if (state.has_map()) close_segment();
    Run run = records.finish();
    run.camera = mapper.camera();
    if (options.realtime) run.realtime.emplace().left_out_of_mapping = mapping.left_out();
    return run;
  }

  FrameView frame_view() const {
    if (!state.has_pose()) return {newest_pyramid, {}, -1};
    // From the segment's map to the world lengths grow by the scale.
    const double idepth_factor = 1.0 / records.scale_of(state.segment());
    return {newest_pyramid, see_points(reference->cloud, motion.T_last_ref(), *newest_pyramid, idepth_factor),
            reference->keyframe_id};
  }

  void say(const Frame& frame, const std::string& what) const {
    if (options.log) options.log("frame " + std::to_string(frame.index) + ": " + what);
  }

  OdometryParams params;
  OdometryOptions options;
  PyramidBuilder builder;
  Bootstrap bootstrap;
  Random random;  // of corners
  Mapper mapper;
  RunRecords records;
  PyramidBuilder rebuilder;  // the mapping side's own
  OdometryState state;
  MappingThread mapping;  // after all that its thread uses

  MotionModel motion;
  KeyframePolicy keyframes;
  MapCoverage coverage;
  std::shared_ptr<const Reference> reference;
  std::shared_ptr<const FramePyramid> newest_pyramid;
  NewestPose newest_pose;
};

Odometry::Odometry(const Camera& camera, const OdometryParams& params, const OdometryOptions& options)
    : impl_(std::make_unique<Impl>(camera, params, options)) {}
Odometry::~Odometry() = default;

const FrameRecord& Odometry::process(const Frame& frame) { return impl_->process(frame); }
FrameView Odometry::frame_view() const { return impl_->frame_view(); }
SettledKeyframes Odometry::settled_keyframes(size_t skip) const { return impl_->records.settled(skip); }
std::optional<UnsettledKeyframes> Odometry::unsettled_keyframes(int version) const {
  return impl_->records.unsettled(version);
}
const NewestPose& Odometry::newest_pose() const { return impl_->newest_pose; }
const FrameRecord& Odometry::pass_over(const Frame& frame, const std::string& why) {
  return impl_->pass_over(frame, why);
}
Run Odometry::finish() { return impl_->finish(); }

}  // namespace edgevo
