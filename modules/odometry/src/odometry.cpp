// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/odometry/odometry.h"

#include <stdexcept>
#include <utility>

#include "bootstrapper.h"
#include "camera_log.h"
#include "collect_evidence.h"
#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/odometry/frame_status.h"
#include "edgevo/odometry/trust.h"
#include "edgevo/witness/corner_witness.h"
#include "frame_log.h"
#include "front_end.h"
#include "map_link.h"
#include "own_parts.h"
#include "stage_timer.h"
#include "state_machine.h"

namespace edgevo {

struct Odometry::Impl {
  Impl(const Rectification& rectification, const OdometryParams& p, const OdometryOptions& o)
      : params(p),
        options(o),
        camera(rectification.camera().pinhole()),
        state(p.recovery.max_frames),
        log(o.map_log ? o.map_log : std::make_shared<MapLog>()),
        frames(rectification, log),
        adjustments(log),
        front_end(rectification, p, o),
        map(rectification, p, o, log),
        bootstrapper(rectification.target(), p, o.seed, &map, &frames) {
    front_end.set_correction(map.initial_camera().correction);
    if (p.health.corners) corners.emplace();
  }

  // ---- one frame ----

  FrameRecord process(const Frame& frame) {
    const std::string where = require_next(frame, "process");
    if (newest_time && !(*newest_time < frame.time)) refuse_time(frame, where, "is not after");
    check_image_size(frame.image, camera, where);
    check_pixels(frame.image, where);
    stated_time = frame.time;
    remember(frame.index, frame.time);
    announce_camera();
    if (front_end.postponed_keyframes() >= options.max_frames_ahead) map.wait_keyframe();
    if (state.has_map()) change_reference(frame);
    front_end.begin_frame(frame.time);
    const ArrivedFrame arrived = find_edges(frame);
    if (state.tracks(arrived.record->evidence.edges)) follow_map(arrived);
    if (!state.has_pose()) ask_corners(arrived, std::nullopt);
    if (state.bootstraps()) bootstrap_map(arrived);
    if (!frame_announced) frames.announce();
    note_pose(*arrived.record);
    frames.run();
    return *arrived.record;
  }

  // The motion model bridges the gap, as after lost frames. A frame with the time of the one before has none
  // of its own: the time of the next frame says how long the gap is.
  FrameRecord skip(const Frame& frame, const std::string& why) {
    const std::string where = require_next(frame, "skip");
    if (stated_time && frame.time < *stated_time) refuse_time(frame, where, "is before");
    const bool has_time = !newest_time || *newest_time < frame.time;
    const Timestamp time = has_time ? frame.time : Timestamp{newest_time->ticks + 1};
    stated_time = frame.time;
    remember(frame.index, time);
    announce_camera();
    FrameRecord& record = frames.begin_frame({frame.index, time, {}, {}});
    trust.interrupt();
    record.state = state.when_skipped();
    record.note = why;
    frames.announce();
    if (has_time) front_end.begin_frame(frame.time);
    frames.run();
    return record;
  }

  // Throws unless the frame may follow those before it. Returns the place for further messages.
  std::string require_next(const Frame& frame, const std::string& function) const {
    const std::string where = "Odometry::" + function + "(), frame " + std::to_string(frame.index);
    require_open(where);
    if (newest_index && frame.index <= *newest_index)
      throw InputError(
          where, "its index is not after that of the frame before (" + std::to_string(*newest_index) + ")",
          "count the frames");
    return where;
  }

  void require_open(const std::string& where) const {
    if (is_finished) throw std::logic_error(where + ": finish() has ended the run; make a new Odometry");
  }

  [[noreturn]] void refuse_time(const Frame& frame, const std::string& where, const char* relation) const {
    throw InputError(where,
                     "its time " + to_string(frame.time) + " s " + relation + " that of the frame before (" +
                         to_string(*newest_time) + " s)",
                     "give frames in the order of their times; skip() those whose time is wrong");
  }

  void remember(int index, Timestamp time) {
    newest_index = index;
    newest_time = time;
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
    const std::shared_ptr<const FramePyramid> before = front_end.newest_pyramid();
    const bool had_mask = before && before->border_mask;
    ArrivedFrame arrived = front_end.find_edges(frame, state.has_pose());
    if (arrived.pyramid->border_mask && !had_mask)
      say(frame, describe_border_mask(arrived.pyramid->masked_share()));
    if (own_parts.take(*arrived.pyramid)) {
      // Two views of a map would see different things.
      bootstrapper.reset();
      say(frame, own_parts.description());
    }
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
    FrameStatus status = frame_status(now.record->evidence, params.status);
    if (const std::string reason = front_end.reason_against_step(track.result.T_cur_ref);
        !reason.empty() && status.state != TrackingState::kLost)
      status = {TrackingState::kLost, reason};
    now.record->note = status.reason;
    act(now.frame, state.after(event_of(status.state), now.frame.index), status.reason);
    if (!state.has_pose()) {
      now.record->state = TrackingState::kLost;
      trust.interrupt();
      return;
    }
    if (const std::optional<Event> seen = front_end.look(now.record->evidence))
      act(now.frame, state.after(*seen, now.frame.index));
    ask_corners(now, front_end.motion_to(track.result.T_cur_ref));
    record_pose(track.result, now.record);
    label(status, now.record);
    TrackedFrame tracked = front_end.accept_pose(now, std::move(track), map.is_keyframe_pending());
    // Whoever follows the events knows a frame before the keyframe that mapping makes of it.
    frames.announce();
    frame_announced = true;
    map.submit(std::move(tracked));
  }

  // In this thread: the pose waits for its evidence, which takes less time than handing it over.
  void ask_corners(const ArrivedFrame& now, const std::optional<SE3>& T_cur_last) {
    if (!corners) return;
    const StageTimer timer(Stage::kWitness, &now.record->stage_ms);
    now.record->evidence.corners = corners->add(*now.pyramid, T_cur_last);
  }

  void record_pose(const TrackResult& tracked, FrameRecord* record) {
    const Reference& reference = *front_end.reference();
    record->covariance = reference.error_factor * tracked.covariance;
    frames.place(state.segment(), reference, tracked.T_cur_ref);
    newest_pose.T_cam_map = tracked.T_cur_ref * reference.T_ref_world;
  }

  // The probability that the motion is right, and with it the state. What follows the state here knows
  // nothing of it: a frame in doubt is tracked and mapped as any other.
  void label(const FrameStatus& by_image, FrameRecord* record) {
    for (const std::shared_ptr<const MapEvent>& event : adjustments.read())
      if (const auto* mapped = std::get_if<FrameMapped>(event.get()); mapped && mapped->adjustment)
        trust.add_adjustment(*mapped->adjustment);
    const FrameTrust found =
        trust.add({record->evidence, state.segment(), newest_pose.T_cam_map->inverse().translation()});
    const FrameStatus status = frame_status(by_image, found);
    record->p_right = found.p_right;
    record->state = status.state;
    record->note = status.reason;
    record->covariance *= covariance_factor(found.p_right);
  }

  // ---- making a map ----

  void bootstrap_map(const ArrivedFrame& now) {
    FrameRecord& record = *now.record;
    frame_announced = false;  // times and note change
    BootstrapStatus status;
    {
      const StageTimer timer(Stage::kBootstrap, &record.stage_ms);
      status = bootstrapper.add(now);
      // The views are kept: a map of later ones, if there is no such part, places all frames.
      if (status.result && own_parts.delays_map(*now.pyramid))
        status = {std::nullopt, OwnParts::kDelayReason};
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
    if (corners) corners->begin_map(begun.reference->median_idepth);
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
    newest_pose.p_right = record.p_right;
    newest_pose.segment = state.has_map() ? state.segment() : -1;
    newest_pose.reference = state.has_map() ? front_end.reference() : nullptr;
    newest_pose.covariance = record.covariance;
  }

  Run finish() {
    require_open("Odometry::finish()");
    is_finished = true;
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
  Pinhole camera;
  OdometryState state;
  std::shared_ptr<MapLog> log;
  FrameLog frames;
  MapCursor adjustments;
  Trust trust;
  FrontEnd front_end;
  OwnParts own_parts;
  MapLink map;
  Bootstrapper bootstrapper;
  std::optional<CornerWitness> corners;
  NewestPose newest_pose;
  bool camera_announced = false;
  bool frame_announced = false;  // the record of the newest frame as it is now
  bool is_finished = false;
  std::optional<int> newest_index;
  std::optional<Timestamp> newest_time;  // of the newest record
  std::optional<Timestamp> stated_time;  // of the newest frame, as given
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
