// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/odometry/odometry.h"

#include <utility>

#include "bootstrapper.h"
#include "camera_log.h"
#include "collect_evidence.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/odometry/frame_status.h"
#include "frame_log.h"
#include "front_end.h"
#include "map_link.h"
#include "stage_timer.h"
#include "state_machine.h"

namespace edgevo {

struct Odometry::Impl {
  Impl(const Rectification& rectification, const OdometryParams& p, const OdometryOptions& o)
      : params(p),
        options(o),
        state(p.recovery.max_frames),
        log(o.map_log ? o.map_log : std::make_shared<MapLog>()),
        frames(rectification, log),
        front_end(rectification, p, o),
        map(rectification, p, o, log),
        bootstrapper(rectification.target(), p, o.seed, &map, &frames) {
    front_end.set_correction(map.initial_camera().correction);
  }

  // ---- one frame ----

  FrameRecord process(const Frame& frame) {
    announce_camera();
    if (front_end.postponed_keyframes() >= options.max_frames_ahead) map.wait_keyframe();
    if (state.has_map()) change_reference(frame);
    front_end.begin_frame(frame.time);
    const ArrivedFrame arrived = find_edges(frame);
    if (state.tracks(arrived.record->evidence.edges)) follow_map(arrived);
    if (state.bootstraps()) bootstrap_map(arrived);
    if (!frame_announced) frames.announce();
    note_pose(*arrived.record);
    frames.run();
    return *arrived.record;
  }

  // The motion model bridges the gap, as after lost frames.
  FrameRecord skip(const Frame& frame, const std::string& why) {
    announce_camera();
    FrameRecord& record = frames.begin_frame(frame);
    record.state = state.when_skipped();
    record.note = why;
    frames.announce();
    front_end.begin_frame(frame.time);
    frames.run();
    return record;
  }

  // Self-calibration may have corrected the map: the next images are corrected in the same way.
  void change_reference(const Frame& frame) {
    const std::shared_ptr<const Reference> newest = map.reference();
    const ImageCorrection before = front_end.correction();
    front_end.change_reference(newest);
    if (front_end.correction() == before) return;
    bootstrapper.reset();
    for (const std::string& line : describe_changes(before, newest->camera)) say(frame, line);
  }

  // A frame that throws leaves no record.
  ArrivedFrame find_edges(const Frame& frame) {
    const double start = thread_cpu_ms();
    const bool had_mask = front_end.newest_pyramid() && front_end.newest_pyramid()->border_mask;
    ArrivedFrame arrived = front_end.find_edges(frame, state.has_pose());
    if (arrived.pyramid->border_mask && !had_mask)
      say(frame, describe_border_mask(arrived.pyramid->masked_share()));
    newest_pose = {};
    arrived.record = &frames.begin_frame(frame);
    frame_announced = false;
    add_image(*arrived.pyramid, &arrived.record->evidence);
    arrived.record->stage_ms.emplace_back(name_of(Stage::kEdges), thread_cpu_ms() - start);
    return arrived;
  }

  // ---- tracking in a map ----

  void follow_map(const ArrivedFrame& now) {
    Track track = front_end.find_pose(now, !state.has_pose());
    const FrameStatus status = frame_status(now.record->evidence, params.status);
    now.record->note = status.reason;
    act(now.frame, state.after(event_of(status.state), now.frame.index), status.reason);
    if (!state.has_pose()) {
      now.record->state = TrackingState::kLost;
      return;
    }
    if (const std::optional<Event> seen = front_end.look(now.record->evidence))
      act(now.frame, state.after(*seen, now.frame.index));
    now.record->state = status.state;
    record_pose(track.result, now.record);
    TrackedFrame tracked = front_end.accept_pose(now, std::move(track), map.is_keyframe_pending());
    // Whoever follows the events knows a frame before the keyframe that mapping makes of it.
    frames.announce();
    frame_announced = true;
    map.submit(std::move(tracked));
  }

  void record_pose(const TrackResult& tracked, FrameRecord* record) {
    const Reference& reference = *front_end.reference();
    record->covariance = reference.error_factor * tracked.covariance;
    frames.place(state.segment(), reference, tracked.T_cur_ref);
    newest_pose.T_cam_map = tracked.T_cur_ref * reference.T_ref_world;
  }

  // ---- making a map ----

  void bootstrap_map(const ArrivedFrame& now) {
    FrameRecord& record = *now.record;
    frame_announced = false;  // times and note change
    BootstrapStatus status;
    {
      const StageTimer timer(Stage::kBootstrap, &record.stage_ms);
      status = bootstrapper.add(now);
      if (status.result) status.reason = make_map(now, *status.result);
    }
    if (record.T_world_cam_live) return;
    record.state = state.without_pose(record.index, record.evidence.edges);
    record.note = (record.note.empty() ? "" : record.note + "; ") + status.reason;
  }

  // Begins a new segment. Returns an empty string, or why the two views make no map.
  std::string make_map(const ArrivedFrame& now, const BootstrapResult& views) {
    const std::optional<double> scale = scale_by_depths();
    const std::string problem = bootstrapper.make_map(views);
    front_end.drop_map();
    state.after(problem.empty() ? Event::kMapMade : Event::kMapRefused, now.frame.index);
    if (problem.empty()) begin_segment(now, bootstrapper.begin_segment(state.segment(), views, scale));
    return problem;
  }

  // Scale (world over map) of a map that replaces one that is still tracked: the median depth in view is
  // kept.
  std::optional<double> scale_by_depths() const {
    if (!state.has_pose()) return std::nullopt;
    return 1.0 / front_end.reference()->median_idepth / kFirstMedianDepth;
  }

  void begin_segment(const ArrivedFrame& now, const NewSegment& begun) {
    front_end.begin_map(begun.reference, begun.motion);
    newest_pose.T_cam_map = begun.reference->T_ref_world;
    now.record->note.clear();
    say(now.frame, "map of " + std::to_string(begun.reference->cloud.points.size()) +
                       " edge points, segment " + std::to_string(state.segment()));
  }

  // ---- state and records ----

  // Before the first frame, and not earlier: consumers may begin until then.
  void announce_camera() {
    if (!std::exchange(camera_announced, true)) log->append(CameraEstimated{map.initial_camera()});
  }

  void act(const Frame& frame, Action action, const std::string& reason = {}) {
    if (action == Action::kLose || action == Action::kBeginBootstrap || action == Action::kDropBootstrap)
      bootstrapper.reset();
    if (action == Action::kLose) say(frame, "LOST: " + reason);
    if (action == Action::kRelocalised) say(frame, "relocalised in the old map");
  }

  void note_pose(const FrameRecord& record) {
    newest_pose.frame_index = record.index;
    newest_pose.time = record.time;
    newest_pose.state = record.state;
    newest_pose.note = record.note;
    newest_pose.segment = state.has_map() ? state.segment() : -1;
    newest_pose.reference = state.has_map() ? front_end.reference() : nullptr;
    newest_pose.covariance = record.covariance;
  }

  Run finish() {
    announce_camera();
    const int skipped = map.finish();
    front_end.drop_map();
    Run run = frames.run().finish();
    if (options.realtime) run.realtime.emplace().left_out_of_mapping = skipped;
    return run;
  }

  FrameView frame_view() const {
    if (!state.has_pose() || !front_end.reference()) return {front_end.newest_pyramid(), {}, -1};
    // From the segment's map to the world lengths are multiplied by the scale.
    return front_end.view(1.0 / frames.T_world_map(state.segment()).scale);
  }

  void say(const Frame& frame, const std::string& what) const {
    if (options.log) options.log("frame " + std::to_string(frame.index) + ": " + what);
  }

  OdometryParams params;
  OdometryOptions options;
  OdometryState state;
  std::shared_ptr<MapLog> log;
  FrameLog frames;
  FrontEnd front_end;
  MapLink map;
  Bootstrapper bootstrapper;
  NewestPose newest_pose;
  bool camera_announced = false;
  bool frame_announced = false;  // the record of the newest frame as it is now
};

Odometry::Odometry(const Camera& camera, const OdometryParams& params, const OdometryOptions& options)
    : impl_(std::make_unique<Impl>(rectification_of(camera, options), params, options)) {}
Odometry::~Odometry() = default;

FrameRecord Odometry::process(const Frame& frame) { return impl_->process(frame); }
FrameView Odometry::frame_view() const { return impl_->frame_view(); }
const NewestPose& Odometry::newest_pose() const { return impl_->newest_pose; }
FrameRecord Odometry::skip(const Frame& frame, const std::string& why) { return impl_->skip(frame, why); }
Run Odometry::finish() { return impl_->finish(); }

}  // namespace edgevo
