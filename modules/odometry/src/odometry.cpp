#include "edgevo/odometry/odometry.h"

#include <algorithm>

#include "camera_log.h"
#include "edgevo/alignment/tracker.h"
#include "edgevo/core/thread_clock.h"
#include "keyframe_decision.h"
#include "mapping_thread.h"
#include "motion_model.h"
#include "rolling_shutter.h"
#include "run_records.h"
#include "see_points.h"

namespace edgevo {
struct Odometry::Impl {
  Impl(const Camera& camera, const OdometryParams& p, const OdometryOptions& o)
      : params(p), options(o), builder(camera, p.edges), bootstrap(camera.pinhole, p.mapping.bootstrap, o.seed),
        random(Random::derive(o.seed, 3)), mapper(camera.pinhole, p.mapping, p.association, p.alignment.photometric, o.seed),
        records(camera.pinhole), rebuilder(camera, p.edges),
        mapping(&mapper, o.realtime, [this](const TrackedFrame& f, const MapUpdate& u) { note_update(f, u); }) {
    // In realtime the mapping must not stand still for long.
    mapper.enable_self_calibration(p.camera, [this](const FramePyramid& old, const ImageMotion& motion, const ImageCorrection& now) {
      rebuilder.set_correction(now);
      return rebuilder.rebuild(old, motion);
    }, o.realtime);
    builder.set_correction(mapper.camera().correction());
  }

  // ---- one frame -------------------------------------------------------------------------------------------------

  const FrameRecord& process(const Frame& frame) {
    if (frames_ahead >= options.max_frames_ahead) mapping.wait_keyframe();
    if (has_map) change_reference(frame, mapping.reference());
    const double start = thread_cpu_ms();
    motion.begin_frame(frame.time);
    expected_motion = expect_motion();
    const std::shared_ptr<const FramePyramid> pyramid = builder.build(frame.image, expected_motion);  // throws for a wrong size: no record then
    if (pyramid->unlit && !(newest_pyramid && newest_pyramid->unlit)) say(frame, describe_unlit(pyramid->unlit_share()));
    newest_pyramid = pyramid;
    FrameRecord& record = records.begin_frame(frame);
    record.stage_ms.emplace_back("edges", thread_cpu_ms() - start);
    record.edges = int(pyramid->finest().edges.pixels.size());
    newest_pose = {};
    if (has_map && (!lost || tries_old_map(record.edges))) track_frame(frame, pyramid, &record);
    if (!has_map || lost || is_out_of_map()) bootstrap_frame(frame, pyramid, &record);
    note_pose(record);
    return record;
  }

  // The motion model bridges the gap, as it does after frames that were lost.
  const FrameRecord& pass_over(const Frame& frame, const std::string& why) {
    FrameRecord& record = records.begin_frame(frame);
    record.state = ever_tracked ? TrackingState::kLost : TrackingState::kBootstrapping;
    record.note = why;
    motion.begin_frame(frame.time);
    return record;
  }

  // After a loss the old map gets a number of tries, and a frame that shows nothing is none.
  bool tries_old_map(int edges) { return edges >= kMinEdges && tries++ < params.recovery.max_frames; }

  void note_pose(const FrameRecord& record) {
    newest_pose.frame_index = record.index;
    newest_pose.time = record.time;
    newest_pose.state = record.state;
    newest_pose.note = record.note;
    newest_pose.segment = has_map ? segment : -1;
    newest_pose.reference = has_map ? reference : nullptr;
    newest_pose.covariance = record.covariance;
  }

  // A rotation has turned the camera away from nearly all that has depth. The rotation can be followed, a translation only while what
  // is left explains the images: where it does not, a new map is sought beside the old one.
  bool is_out_of_map() {
    // Bad light leaves few points, too, but they are in view: a new map would see no more of them.
    const bool few = has_map && !lost && reference->known_points < kFewKnownPoints && reference->view_share < kTurnedAwayShare;
    if (!few) unexplained_frames = 0;  // fast motion blurs images of a map that is in view, too
    if (seeking && !few && has_map && !lost) bootstrap.reset();
    seeking = few && (seeking || unexplained_frames >= kManyUnexplained);
    return seeking;
  }

  void track_frame(const Frame& frame, const std::shared_ptr<const FramePyramid>& pyramid, FrameRecord* record) {
    const double start = thread_cpu_ms();
    TrackResult found = track(*pyramid, reference->cloud, motion.starts(), params.alignment);
    const bool held = !lost && hold_steady(motion, *pyramid, reference->cloud, params.alignment, &found);
    Tracked tracked = put_rows_right(*pyramid, found);
    record->stage_ms.emplace_back("alignment", thread_cpu_ms() - start);
    if (is_doubtful(tracked.result)) ask_corners(*pyramid, &tracked, record);
    const TrackResult& result = tracked.result;
    record->inlier_share = result.evidence.inlier_share;
    record->residual_px = result.stats.residual_px;
    record->note = result.reason;
    if (result.verdict == TrackingState::kLost || (lost && result.verdict != TrackingState::kTracking)) {
      if (!lost) lose(frame, result.reason);
      record->state = TrackingState::kLost;
      return;
    }
    if (lost) say(frame, "tracking resumed in the old map");
    lost = false;
    record->state = result.verdict;
    const bool explained = result.stats.matched_share() >= kExplainedShare && result.stats.residual_px <= kExplainedResidualPx;
    unexplained_frames = std::clamp(unexplained_frames + (explained ? -1 : 1), 0, 2 * kManyUnexplained);
    record->covariance = reference->error_factor * result.covariance;
    records.place(record, segment, reference->keyframe_id, result.T_cur_ref, reference->T_ref_world);
    newest_pose.T_cam_map = result.T_cur_ref * reference->T_ref_world;
    motion.follow(result.T_cur_ref, held);
    submit(frame, pyramid, std::move(tracked), record);
  }

  // A frame as it was tracked.
  struct Tracked {
    TrackResult result;
    Vector6d twist = Vector6d::Zero();  // how the camera moved when the image was taken
    std::vector<CornerPair> corners;    // seen in the reference and here, where they were asked
  };

  // The last frame became a keyframe.
  bool follows_keyframe() const { return frames_since_keyframe == 0; }

  // About to be lost; or explained badly, and the map moves on at every frame: large motion. At small motion bad light does that, and it
  // misleads corners, too.
  bool is_doubtful(const TrackResult& result) const {
    if (lost || !(result.evidence.inlier_share < params.mapping.corners.max_inlier_share)) return false;
    return result.verdict == TrackingState::kLost || (follows_keyframe() && decide(result).needed);
  }

  // A second opinion (mapping/corner_motion.h), sought from where the camera was expected, not from what the edges made of it: rotation and
  // direction from corners, the length from the edges. The pose that more speaks for is taken; at large motion the corners go with the
  // frame into the adjustment either way.
  void ask_corners(const FramePyramid& pyramid, Tracked* tracked, FrameRecord* record) {
    const double start = thread_cpu_ms();
    const SE3 expected = motion.predict();
    std::optional<CornerMotion> found =
        find_corner_motion(builder.pinhole(), *reference->cloud.pyramid, pyramid, expected, params.mapping.corners, &random);
    if (found) {
      const SE3 T_cur_ref(found->T_to_from.rotation(), expected.translation().norm() * found->T_to_from.translation());
      Tracked other = put_rows_right(pyramid, track_along(pyramid, reference->cloud, T_cur_ref, params.alignment));
      if (support(other.result.evidence, params.alignment) > support(tracked->result.evidence, params.alignment)) *tracked = std::move(other);
      if (follows_keyframe()) tracked->corners = std::move(found->pairs);
    }
    record->stage_ms.emplace_back("corners", thread_cpu_ms() - start);
  }

  // ---- rolling shutter: core/image_correction.h ------------------------------------------------------------------------

  bool is_rolling() const { return builder.correction().readout_s != 0; }

  // What the rows of the next image are made ready for: the camera goes on as before.
  ImageMotion expect_motion() const {
    const std::optional<Vector6d> twist = motion.expected_twist();
    if (!is_rolling() || !has_map || lost || !twist) return {};
    return image_motion(builder.pinhole(), reference->cloud, motion.predict(), *twist, reference->median_idepth);
  }

  ImageMotion found_motion(const Vector6d& twist, const SE3& T_cur_ref) const {
    if (expected_motion.is_known()) return {twist, expected_motion.idepth};
    return image_motion(builder.pinhole(), reference->cloud, T_cur_ref, twist, reference->median_idepth);
  }

  Tracked put_rows_right(const FramePyramid& pyramid, const TrackResult& result) const {
    const Vector6d twist = motion.twist(result.T_cur_ref);
    const bool again = is_rolling() && result.verdict != TrackingState::kLost;
    return {again ? track_rows(pyramid, twist, result) : result, twist, {}};
  }

  // The pose once more, for the rows as they were taken.
  TrackResult track_rows(const FramePyramid& pyramid, const Vector6d& twist, const TrackResult& first) const {
    const ReferenceCloud shifted = shift_cloud(builder.pinhole(), reference->cloud, first.T_cur_ref, builder.correction().readout_s,
                                               expected_motion, found_motion(twist, first.T_cur_ref));
    const TrackResult again = track_again(pyramid, shifted, first.T_cur_ref, params.alignment);
    return again.verdict != TrackingState::kLost ? again : first;
  }

  ReferenceFit fit_with(const TrackResult& r) const {
    return {r.stats.matched_share(), r.evidence.inlier_share, std::max(fit.best_inlier_share, r.evidence.inlier_share)};
  }

  KeyframeDecision decide(const TrackResult& r) const {
    return decide_keyframe(builder.pinhole(), reference->cloud, r.T_cur_ref, frames_since_keyframe + 1, fit_with(r), params.mapping.keyframe);
  }

  void submit(const Frame& frame, const std::shared_ptr<const FramePyramid>& pyramid, Tracked from, FrameRecord* record) {
    const TrackResult& result = from.result;
    TrackedFrame tracked;
    tracked.frame_index = frame.index;
    tracked.time = frame.time;
    tracked.pyramid = pyramid;
    tracked.reference_id = reference->keyframe_id;
    tracked.T_cam_ref = result.T_cur_ref;
    tracked.covariance = result.covariance;
    tracked.corners = std::move(from.corners);
    const KeyframeDecision decision = decide(result);
    fit = fit_with(result);
    ++frames_since_keyframe;
    const NearestKeyframe nearest =
        find_nearest_keyframe(builder.pinhole(), *reference, result.T_cur_ref, params.mapping.keyframe);
    const bool back =
        is_back(builder.pinhole(), nearest, reference->keyframe_id, decision.flow_px, params.mapping.keyframe);
    if (back) tracked.return_to = nearest.id;
    const bool pending = mapping.keyframe_pending();
    frames_ahead = decision.needed && pending ? frames_ahead + 1 : 0;
    tracked.make_keyframe = decision.needed && !back && !pending;
    if (tracked.make_keyframe) frames_since_keyframe = 0;
    if (tracked.make_keyframe && params.camera.knows_rolling()) straighten_keyframe(result.T_cur_ref, from.twist, &tracked, record);
    mapping.submit(std::move(tracked));
  }

  // What is measured in a keyframe stays: its rows are put where the motion that was found has taken them.
  void straighten_keyframe(const SE3& T_cur_ref, const Vector6d& twist, TrackedFrame* tracked, FrameRecord* record) {
    const double start = thread_cpu_ms();
    tracked->motion = found_motion(twist, T_cur_ref);
    if (is_rolling()) {
      tracked->pyramid = builder.rebuild(*tracked->pyramid, tracked->motion);
      for (CornerPair& c : tracked->corners) c.to = shift_ray(builder.pinhole(), builder.correction().readout_s, expected_motion, tracked->motion, c.to);
    }
    record->stage_ms.front().second += thread_cpu_ms() - start;  // the edges
  }

  // A new keyframe became the reference: re-express the last pose against it.
  void change_reference(const Frame& frame, std::shared_ptr<const Reference> newest) {
    if (newest == reference) return;
    if (newest->camera.correction() != builder.correction()) change_camera(frame, newest->camera);
    if (reference) {
      const auto old = newest->T_keyframe_world.find(reference->keyframe_id);
      const SE3 T_old_world = old != newest->T_keyframe_world.end() ? old->second : reference->T_ref_world;
      motion.change_reference(T_old_world * newest->T_ref_world.inverse());
    }
    reference = std::move(newest);
    fit = kNoneTracked;
  }

  // The map was corrected for a residual distortion: the images that follow are too.
  void change_camera(const Frame& frame, const CameraRefinement& camera) {
    const ImageCorrection before = builder.correction();
    builder.set_correction(camera.correction());
    bootstrap.reset();
    for (const std::string& line : describe_changes(before, camera)) say(frame, line);
  }

  // ---- bootstrap and segments --------------------------------------------------------------------------------------

  void bootstrap_frame(const Frame& frame, const std::shared_ptr<const FramePyramid>& pyramid, FrameRecord* record) {
    const double start = thread_cpu_ms();
    BootstrapStatus status = bootstrap.add(frame.index, frame.time, pyramid);
    if (status.result) {
      mapping.wait_idle();
      const std::optional<double> depth = has_map && !lost ? std::optional<double>(1.0 / reference->median_idepth) : std::nullopt;
      if (has_map) close_segment();
      status.reason = mapper.initialise(*status.result);
      bootstrap.reset();
      if (status.reason.empty()) begin_segment(frame, *status.result, depth, record);
    }
    record->stage_ms.emplace_back("bootstrap", thread_cpu_ms() - start);
    if (record->T_world_cam_live) return;
    // After a loss a frame stays LOST until there is something to follow again.
    const bool nothing_to_follow = record->edges < kMinEdges;
    record->state = ever_tracked && (nothing_to_follow || lost_at == frame.index) ? TrackingState::kLost
                                                                                  : TrackingState::kBootstrapping;
    record->note = (record->note.empty() ? "" : record->note + "; ") + status.reason;
  }

  void begin_segment(const Frame& frame, const BootstrapResult& result, std::optional<double> depth_before, FrameRecord* record) {
    ++segment;
    mapping.refresh();
    reference = mapping.reference();
    const std::optional<double> scale =
        depth_before ? std::optional<double>(*depth_before / params.mapping.bootstrap.median_depth) : std::nullopt;
    records.begin_segment(segment, result, scale);
    place_bootstrap_frames(result);
    const SE3& T_cur = reference->T_ref_world;
    newest_pose.T_cam_map = T_cur;
    const auto before = records.pose_before(frame.index, segment);
    motion.restart(before ? std::optional<SE3>(T_cur * before->inverse()) : std::nullopt);
    frames_since_keyframe = 0;
    has_map = ever_tracked = true;
    lost = seeking = false;
    unexplained_frames = 0;
    record->note.clear();
    say(frame, "map of " + std::to_string(reference->cloud.points.size()) + " edge points, segment " + std::to_string(segment));
  }

  // Frames between the two views get their pose from the finished map; those whose image is gone, or that the map does not explain, keep
  // the one of PnP. A pose that the map does not explain is DEGRADED.
  void place_bootstrap_frames(const BootstrapResult& result) {
    for (const BootstrapView& view : result.views) {
      FrameRecord* record = records.find(view.frame_index);
      if (!record || !view.placed) continue;
      const bool is_first = view.frame_index == result.views.front().frame_index;
      const bool is_last = view.frame_index == result.views.back().frame_index;
      SE3 T_cam_ref = view.T_cam_first * reference->T_ref_world.inverse();
      if (is_first) T_cam_ref = reference->T_keyframe_world.begin()->second * reference->T_ref_world.inverse();
      if (is_last) T_cam_ref = SE3();
      record->state = TrackingState::kTracking;
      if (view.pyramid) {
        const TrackResult r = track(*view.pyramid, reference->cloud, {T_cam_ref}, params.alignment);
        if (r.verdict != TrackingState::kTracking) record->state = TrackingState::kDegraded;
        if (r.verdict != TrackingState::kLost && !is_first && !is_last)
          T_cam_ref = r.T_cur_ref, record->covariance = reference->error_factor * r.covariance;
        record->inlier_share = r.evidence.inlier_share;
        record->residual_px = r.stats.residual_px;
      }
      record->note.clear();
      records.place(record, segment, reference->keyframe_id, T_cam_ref, reference->T_ref_world);
    }
  }

  void lose(const Frame& frame, const std::string& reason) {
    lost = true;
    lost_at = frame.index;
    tries = 0;
    bootstrap.reset();
    say(frame, "LOST: " + reason);
  }

  void close_segment() {
    mapper.close();
    records.retire(mapper.take_retired(), segment);
    records.revise(mapper.take_revised());
    reference.reset();
    has_map = false;
  }

  // ---- records --------------------------------------------------------------------------------------------------------

  // Called by the mapping thread.
  void note_update(const TrackedFrame& frame, const MapUpdate& update) {
    records.note_mapping(frame.frame_index, update);
    records.retire(mapper.take_retired(), segment);
    records.revise(mapper.take_revised());
  }

  Run finish() {
    mapping.wait_idle();
    if (has_map) close_segment();
    Run run = records.finish();
    run.camera = mapper.camera();
    if (options.realtime) run.realtime.emplace().left_out_of_mapping = mapping.left_out();
    return run;
  }

  FrameView frame_view() const {
    FrameView view;
    view.pyramid = newest_pyramid;
    if (!has_map || lost) return view;
    view.reference_keyframe = reference->keyframe_id;
    // From the segment's map to the world lengths grow by the scale.
    view.points = see_points(reference->cloud, motion.T_last_ref(), *newest_pyramid, 1.0 / records.scale_of(segment));
    return view;
  }

  void say(const Frame& frame, const std::string& what) const {
    if (options.log) options.log("frame " + std::to_string(frame.index) + ": " + what);
  }

  static constexpr int kMinEdges = 200;        // with fewer an image shows nothing to follow
  static constexpr int kFewKnownPoints = 200;  // of known depth in the reference: fewer may not hold a translation
  static constexpr double kTurnedAwayShare = 0.15;  // of the window's points in view; below it the camera has turned away from the map
  static constexpr ReferenceFit kNoneTracked{0, 0, 0};  // of a new reference
  // A frame is explained where all points, those of guessed depth too, lie on edges as they do in view of a map.
  static constexpr double kExplainedShare = 0.7, kExplainedResidualPx = 1.0;
  static constexpr int kManyUnexplained = 12;  // more frames that are not explained than others, of late: a keyframe may still mend it

  OdometryParams params;
  OdometryOptions options;
  PyramidBuilder builder;
  Bootstrap bootstrap;
  Random random;  // of ask_corners
  Mapper mapper;
  RunRecords records;
  PyramidBuilder rebuilder;  // the mapping side's own
  MappingThread mapping;  // last but the state: its thread ends before what it uses

  std::shared_ptr<const FramePyramid> newest_pyramid;
  std::shared_ptr<const Reference> reference;
  NewestPose newest_pose;
  MotionModel motion;
  ImageMotion expected_motion;    // that the newest image was made ready for
  int frames_since_keyframe = 0;
  ReferenceFit fit = kNoneTracked;  // of `reference`
  int frames_ahead = 0;  // the latest of a row that would have been keyframes, had the mapping not been busy with one
  int segment = -1, lost_at = -1, unexplained_frames = 0;
  int tries = 0;         // frames since a loss that were tried against the old map
  bool seeking = false;  // a bootstrap runs beside the map, see is_out_of_map
  bool has_map = false, lost = false, ever_tracked = false;
};

Odometry::Odometry(const Camera& camera, const OdometryParams& params, const OdometryOptions& options)
    : impl_(std::make_unique<Impl>(camera, params, options)) {}
Odometry::~Odometry() = default;

const FrameRecord& Odometry::process(const Frame& frame) { return impl_->process(frame); }
FrameView Odometry::frame_view() const { return impl_->frame_view(); }
SettledKeyframes Odometry::settled_keyframes(size_t skip) const { return impl_->records.settled(skip); }
const NewestPose& Odometry::newest_pose() const { return impl_->newest_pose; }
const FrameRecord& Odometry::pass_over(const Frame& frame, const std::string& why) { return impl_->pass_over(frame, why); }
Run Odometry::finish() { return impl_->finish(); }

}  // namespace edgevo
