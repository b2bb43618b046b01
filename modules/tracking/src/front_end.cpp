// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/front_end.h"

#include <utility>

#include "edgevo/alignment/projection.h"
#include "edgevo/confidence/collect_evidence.h"
#include "edgevo/confidence/frame_status.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/core/stage_timer.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/core/trace.h"
#include "see_points.h"

namespace edgevo {
namespace {

// Of a torn image only what its own rows show; the whole scene if that is nothing.
std::shared_ptr<const Reference> in_own_rows(std::shared_ptr<const Reference> scene,
                                             const FramePyramid& frame, const SE3& T_cur_ref) {
  if (!frame.is_torn || !T_cur_ref.is_finite()) return scene;
  std::vector<size_t> kept;
  const std::vector<CloudPoint>& points = scene->cloud.points;
  const Pinhole& camera = frame.finest().pinhole;
  const Eigen::Matrix3d R = T_cur_ref.R();
  for (size_t i = 0; i < points.size(); ++i) {
    const Projection p = project(camera, R, T_cur_ref.translation(), points[i].ray, points[i].idepth);
    const bool is_old = p.valid && camera.contains(p.px) && frame.is_ego(p.px.x(), p.px.y());
    if (!is_old) kept.push_back(i);
  }
  if (kept.empty()) return scene;
  auto part = std::make_shared<Reference>(*scene);
  part->cloud = part_of(scene->cloud, kept);
  return part;
}

}  // namespace

FrontEnd::FrontEnd(const Rectification& rectification, const TrackingParams& params,
                   const TrackingOptions& options, MotionHistory* history)
    : params_(params),
      rectification_(rectification),
      builder_(rectification, params.edges, options.detectors),
      masks_(rectification, params.edges),
      random_(Random::derive(options.seed, 3)),
      history_(history),
      keyframes_(rectification.target(), params.keyframe),
      coverage_(params.bootstrap_out_of_view, params.status) {
  if (options.corners_in_parallel)
    corners_in_parallel_ = std::make_unique<CornerSearch>(params, options.seed);
}

void FrontEnd::begin_frame(Timestamp time) {
  motion_.begin_frame(time);
  begun_ = time;
  std::optional<KnownRotation> known;
  if (const std::optional<CameraTurn> turn = gyro_.turn(pose_time_, time)) {
    const RateOfPoints points =
        gyro_.rate_of_points(time, builder_.correction().readout_s).value_or(RateOfPoints());
    known = {rotation_vector(turn->R), points.rate, points.turning};
  }
  motion_.know_rotation(known);
}

std::optional<CameraTurn> FrontEnd::heading() const {
  std::optional<CameraTurn> turn = gyro_.turn(pose_time_, begun_);
  if (!turn || !reference_) return std::nullopt;
  turn->R = turn->R * motion_.T_last_ref().rotation() * reference_->T_ref_world.rotation();
  return turn;
}

std::optional<RotationPrior> FrontEnd::turn_since_reference(Timestamp time) const {
  const std::optional<CameraTurn> turn = gyro_.turn(reference_->time, time);
  if (!turn || !motion_.knows_rotation()) return std::nullopt;
  return RotationPrior{turn->R, turn->covariance.inverse()};
}

// What the images of this frame and the one before show of the rotation between them, for the gyro.
void FrontEnd::see_turn(const ArrivedFrame& now, const Track& track) {
  if (!gyro_.has_samples()) return;
  const RotationByImage& to = track.by_image;
  const bool is_good =
      classify(now.record->evidence, params_.status) == PoseSupport::kGood && !track.is_zero_velocity;
  if (is_good && turned_ && motion_.frames_since() <= 1) {
    const Eigen::Quaterniond R = to.R_cur_ref * turned_->R_cur_ref.conjugate();
    const Eigen::Matrix3d M = R.toRotationMatrix();
    seen_turn_ = {pose_time_, now.frame.time, R, to.covariance + M * turned_->covariance * M.transpose()};
  }
  turned_ = is_good ? std::make_optional(to) : std::nullopt;
}

void FrontEnd::confirm_turn() {
  in_doubt_ = false;
  if (const auto turn = std::exchange(seen_turn_, std::nullopt))
    gyro_.see(turn->begin, turn->end, turn->R, turn->covariance);
}

ArrivedFrame FrontEnd::find_edges(const Frame& frame, bool has_pose, const ImageExposure& exposure) {
  const RowRectification rows{row_time(builder_.correction()), expected_motion(has_pose), rectification_};
  builder_.set_old_rows(exposure.old_rows);
  newest_pyramid_ = builder_.build(frame, rows.expected, &masks_);
  StillCells still = masks_.still_cells();
  if (still.empty()) stationary_.clear();
  return {frame, newest_pyramid_, rows, std::move(still), masks_.may_show_ego_part()};
}

// The motion for which the rows of the next image are rectified: constant velocity, and turns as the gyro.
ImageMotion FrontEnd::expected_motion(bool has_pose) const {
  const std::optional<Vector6d> twist = motion_.expected_twist();
  if (builder_.correction().readout_s == 0 || !has_pose || !twist) return {};
  ImageMotion expected = image_motion(builder_.pinhole(), reference_->cloud, motion_.predict(), *twist,
                                      reference_->median_idepth);
  expected.turning = motion_.turning();
  return expected;
}

Track FrontEnd::find_pose(ArrivedFrame* now, bool was_lost) {
  const TraceScope traced(name_of(Stage::kAlignment));
  const double start = thread_cpu_ms();
  Track track = track_scene(now, was_lost);
  FrameRecord& record = *now->record;
  record.stage_ms.emplace_back(name_of(Stage::kAlignment), thread_cpu_ms() - start - track.corner_ms);
  if (track.corner_ms > 0) record.stage_ms.emplace_back(name_of(Stage::kCorners), track.corner_ms);
  add_pose(track.result, *reference_, &record.evidence);
  record.evidence.step_sigmas = track.step_sigmas;
  if (!is_lost(classify(record.evidence, params_.status)))
    track.result.correlated_px2 = correlated_residual_.add(track.result.smooth);
  record.evidence.stands = stationary_.stands(now->still, now->pyramid->finest().pinhole, reference_->cloud,
                                              track.result.T_cur_ref, history_->typical_step());
  return track;
}

TrackingTask FrontEnd::task(const ArrivedFrame& now, const Reference& scene, bool was_lost) {
  return {*now.pyramid,
          scene,
          motion_,
          history_->median_step(),
          keyframes_,
          params_,
          now.rows,
          was_lost,
          &random_,
          corners_in_parallel_ != nullptr,
          turn_since_reference(now.frame.time)};
}

// Without what moves by itself; again, if something is found to.
Track FrontEnd::track_scene(ArrivedFrame* now, bool was_lost) {
  const auto scene_at = [&](const SE3& T_cur_ref) {
    return in_own_rows(bodies_.without(reference_, builder_.pinhole(), T_cur_ref), *now->pyramid, T_cur_ref);
  };
  const auto track = [&](const Reference& scene) { return track_frame(task(*now, scene, was_lost)); };
  bodies_.follow(*now->pyramid);
  std::shared_ptr<const Reference> scene = scene_at(motion_.predict());
  Track found = track(*scene);
  doubt_gyro(*scene, was_lost, now, &found);
  if (bodies_.look(*now->pyramid, *scene, found.result.T_cur_ref, params_.alignment)) {
    const double corner_ms = found.corner_ms;
    scene = scene_at(found.result.T_cur_ref);
    found = track(*scene);
    found.corner_ms += corner_ms;
  }
  found.scene = scene;
  update_zero_velocity(*now, was_lost, &found);
  found.moving_objects =
      bodies_.evaluate(builder_.pinhole(), motion_to(found.result.T_cur_ref), reference_->median_idepth);
  return found;
}

// Whether no pose fits, or the image turns otherwise than a gyro does that turns with the camera. That it may
// not, by earlier frames, is no reason to go on with rows that it bends.
bool FrontEnd::contradicts_gyro(const ArrivedFrame& now, const Track& found) const {
  const std::optional<CameraTurn> turn = gyro_.turn(reference_->time, now.frame.time);
  if (!turn) return false;
  const Eigen::Matrix3d if_right = turn->covariance - turn->broken2 * Eigen::Matrix3d::Identity();
  return !SupportScorer(params_.status).fits(found.result) ||
         RotationPrior{turn->R, if_right.inverse()}.is_far_off(found.by_image.R_cur_ref,
                                                               found.by_image.covariance);
}

// A frame that turns otherwise than the gyro says is seen again without it, its rows too, and what the image
// supports better counts. Else a gyro that is wrong bends rows, pose and map, and no image contradicts it.
// While the map is in doubt, perhaps since it is bent already, so is the gyro: a pose without it counts that
// is as much better supported as one of unusual motion has to be.
void FrontEnd::doubt_gyro(const Reference& scene, bool was_lost, ArrivedFrame* now, Track* found) {
  if (was_lost || !motion_.knows_rotation()) return;
  const bool contradicts = contradicts_gyro(*now, *found);
  if (!contradicts && !in_doubt_) return;
  const SupportScorer scorer(params_.status);
  const MotionModel with_gyro = motion_;
  motion_.know_rotation(std::nullopt);
  ArrivedFrame again = *now;
  again.rows.expected = expected_motion(true);
  if (again.rows.is_rolling()) again.pyramid = builder_.rebuild(*now->pyramid, again.rows.expected);
  Track by_image = track_frame(task(again, scene, was_lost));
  const double corner_ms = found->corner_ms + by_image.corner_ms;
  const double likelihood = contradicts ? 1 : kUnusualLikelihood;
  if (likelihood * scorer.score(by_image.result) > scorer.score(found->result)) {
    *found = std::move(by_image);
    if (newest_pyramid_ == now->pyramid) newest_pyramid_ = again.pyramid;
    now->pyramid = again.pyramid;
    now->rows = again.rows;
  } else {
    motion_ = with_gyro;
  }
  found->corner_ms = corner_ms;
}

// The pose of before, where something hides so much of the view that no pose is supported.
void FrontEnd::update_zero_velocity(const ArrivedFrame& now, bool was_lost, Track* found) {
  if (classify(evidence_of(found->result), params_.status) == PoseSupport::kGood) return;
  std::shared_ptr<const Reference> still =
      stationary_.still_part(*now.pyramid, now.still, reference_, found->result.T_cur_ref, params_.alignment);
  if (!still) return;
  const double corner_ms = found->corner_ms;
  *found = zero_velocity_update(task(now, *still, was_lost), stationary_.T_standing_ref());
  found->corner_ms = corner_ms;
  found->scene = std::move(still);
}

// Where a translation is not observable, points at infinity, or a few wrong ones, allow any.
std::optional<Reason> FrontEnd::step_gate(const SE3& T_cur_ref) const {
  const double step = motion_.step_to(T_cur_ref),
               most = history_->largest_step(params_.step.times, 1 / reference_->median_idepth);
  if (step <= most) return std::nullopt;
  return Reason{ReasonKind::kStep, params_.step.times * step / most};
}

// What a search of corners must know of a frame before its pose is accepted. A frame that comes during
// another search does without.
std::optional<CornerJob> FrontEnd::corner_job(const ArrivedFrame& now, const Track& track) const {
  if (!track.wants_corners || corners_in_parallel_->is_busy()) return std::nullopt;
  return CornerJob{now.pyramid, track.scene,         motion_, history_->median_step(), keyframes_,
                   now.rows,    *track.wants_corners};
}

void FrontEnd::follow(const ArrivedFrame& now, const Track& track) {
  const SE3& T_cur_ref = track.result.T_cur_ref;
  seen_turn_.reset();
  in_doubt_ = true;
  see_turn(now, track);
  pose_time_ = now.frame.time;
  const bool stands = now.record->evidence.stands;
  history_->add({(T_cur_ref * reference_->T_ref_world).inverse(), motion_to(T_cur_ref),
                 motion_.frames_since(), stands, track.used_median_motion});
  motion_.follow(T_cur_ref);
  stationary_.follow(now.still, T_cur_ref, stands);
}

TrackedFrame FrontEnd::accept_pose(const ArrivedFrame& now, Track track, bool is_mapping_busy) {
  std::optional<CornerJob> corners = corner_job(now, track);
  follow(now, track);
  const KeyframeDecision decision =
      keyframes_.decide(track.result, *reference_, is_mapping_busy || now.pyramid->is_torn);
  now.record->keyframe_reason = decision.reason;
  TrackedFrame tracked;
  tracked.frame_index = now.frame.index;
  tracked.time = now.frame.time;
  tracked.pyramid = now.pyramid;
  tracked.reference_id = reference_->keyframe_id;
  tracked.T_cam_ref = track.result.T_cur_ref;
  tracked.covariance = track.result.covariance;
  tracked.corners = std::move(track.corners);
  if (const std::optional<RotationPrior>& turn = track.result.turn)
    tracked.turn = {reference_->keyframe_id, turn->R_expected, turn->information};
  tracked.moving = bodies_.areas();
  tracked.return_to = decision.return_to;
  tracked.make_keyframe = decision.action == KeyframeDecision::Action::kMake;
  if (tracked.make_keyframe && params_.rectify_keyframes) rectify_keyframe(now, track.twist, &tracked);
  if (tracked.make_keyframe && corners) {
    corners->measured = tracked.motion;
    tracked.by_corners = corners_in_parallel_->begin(std::move(*corners));
  }
  return tracked;
}

// Measurements in a keyframe are final: its rows are rectified again, for the motion that was found.
void FrontEnd::rectify_keyframe(const ArrivedFrame& now, const Vector6d& twist, TrackedFrame* tracked) {
  const TraceScope traced("rows of a keyframe");
  const double start = thread_cpu_ms();
  tracked->motion = measured_motion(builder_.pinhole(), *reference_, now.rows, tracked->T_cam_ref, twist,
                                    motion_.turning());
  if (now.rows.is_rolling()) {
    tracked->pyramid = builder_.rebuild(*now.pyramid, tracked->motion);
    for (CornerPair& c : tracked->corners)
      c.to = shift_ray(rectification_, now.rows.row_time_s, now.rows.expected, tracked->motion, c.to);
  }
  // The first stage of a frame is Stage::kEdges.
  now.record->stage_ms.front().second += thread_cpu_ms() - start;
}

void FrontEnd::change_reference(std::shared_ptr<const Reference> newest) {
  if (newest == reference_) return;
  if (reference_) {
    const auto old = newest->T_keyframe_world.find(reference_->keyframe_id);
    const SE3 T_old_world = old != newest->T_keyframe_world.end() ? old->second : reference_->T_ref_world;
    motion_.change_reference(T_old_world * newest->T_ref_world.inverse());
    if (turned_)
      turned_->R_cur_ref = turned_->R_cur_ref * (T_old_world * newest->T_ref_world.inverse()).rotation();
    stationary_.change_reference(T_old_world * newest->T_ref_world.inverse());
  }
  reference_ = std::move(newest);
}

void FrontEnd::begin_map(std::shared_ptr<const Reference> reference, const std::optional<SE3>& motion) {
  reference_ = std::move(reference);
  motion_.restart(motion);
  pose_time_ = begun_;
  turned_.reset();
  in_doubt_ = false;
  history_->begin_map();
  keyframes_.restart();
  coverage_.restart();
  bodies_.clear();
  stationary_.clear();
}

FrameView FrontEnd::view(double idepth_factor) const {
  return {newest_pyramid_,
          see_points(reference_->cloud, motion_.T_last_ref(), *newest_pyramid_, idepth_factor),
          reference_->keyframe_id};
}

}  // namespace edgevo
