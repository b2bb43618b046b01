// SPDX-License-Identifier: BSD-3-Clause
#include "pose_stream.h"

#include <algorithm>

namespace edgevo {
namespace {

// Frames whose poses are remembered: those of a long bootstrap (FrameLog::forget).
constexpr size_t kKept = 2000;
// Seconds between two frames that a velocity is taken from: beyond it, it is none of now.
constexpr double kMaxStep_s = 0.5;

RosLevel level_of(TrackingState state) {
  switch (state) {
    case TrackingState::kTracking:
      return RosLevel::kInfo;
    case TrackingState::kLost:
      return RosLevel::kError;
    case TrackingState::kBootstrapping:
    case TrackingState::kDegraded:
      break;
  }
  return RosLevel::kWarn;
}

std::string name_of(TrackingState state) { return std::string(to_string(state)); }

}  // namespace

void PoseStream::add(const FrameRecord& frame) {
  const bool is_new_frame = is_new(frame);
  if (is_new_frame) {
    newest_ = frame.index;
    now_ = std::max(now_, frame.time, [](Timestamp a, Timestamp b) { return a < b; });
    begin(frame.time);
  }
  if (frame.index == newest_) note_state(frame, is_new_frame);
  const bool is_waited_for = is_new_frame || without_pose_.count(frame.index) > 0;
  if (frame.T_world_cam_live && is_waited_for && frame.T_world_cam_live->is_finite()) {
    without_pose_.erase(frame.index);
    write_pose(frame);
  } else if (is_new_frame) {
    without_pose_.insert(frame.index);
  }
  forget_old();
}

// What holds for the whole file.
void PoseStream::begin(Timestamp time) {
  if (has_begun_) return;
  has_begun_ = true;
  file_.write(Topic::kTfStatic, time, tf_message({{{time, kBaseFrame}, kCameraFrame, frames_.T_base_cam()}}));
  file_.write(Topic::kIsMetric, time, bool_message(frames_.is_metric()));
  write_changes(0);
}

void PoseStream::note_state(const FrameRecord& frame, bool is_new) {
  if (state_ == frame.state) return;
  const std::string before = state_ && is_new ? name_of(*state_) + " -> " : "";
  log(level_of(frame.state), "frame " + std::to_string(frame.index) + ": " + before + name_of(frame.state) +
                                 (frame.note.empty() ? "" : ": " + frame.note));
  state_ = frame.state;
}

void PoseStream::log(RosLevel level, const std::string& text) {
  file_.write(Topic::kLog, now_, log_message(now_, level, text));
}

void PoseStream::note_segment(const SegmentPlaced& placed) {
  log(RosLevel::kInfo, "map of segment " + std::to_string(placed.segment));
}

void PoseStream::note_change(const EpochsPlaced& placed) {
  write_changes(frames_.changes());
  log(RosLevel::kInfo, "map -> odom has changed: " + std::to_string(placed.epochs.size()) +
                           " intervals of one unit of length were placed anew");
}

void PoseStream::write_changes(int count) {
  if (count == changes_) return;
  changes_ = count;
  file_.write(Topic::kMapChanges, now_, count_message(uint32_t(count)));
}

// A tick after the newest frame, whose transform stays.
void PoseStream::write_last_change(const std::optional<SE3>& T_map_odom, int count) {
  constexpr double kSame = 1e-9;  // of lengths and radians: what rounding leaves
  if (!T_map_odom || (frames_.T_map_odom().inverse() * *T_map_odom).log().norm() <= kSame) return;
  now_ = {now_.ticks + 1};
  write_changes(count);
  log(RosLevel::kInfo, "map -> odom has changed: these are the final poses");
  file_.write(Topic::kTf, now_,
              tf_message({{{now_, kMapFrame}, kOdomFrame, *T_map_odom},
                          {{now_, kOdomFrame}, kBaseFrame, newest_pose_->second}}));
}

void PoseStream::write_pose(const FrameRecord& frame) {
  const double length = frames_.metres_per_map_unit(frame.segment);
  const KnownPose pose{frame.time, frame.segment, frames_.T_odom_base(*frame.T_world_cam_live),
                       body_covariance(frame.covariance, length, frames_.T_base_cam())};
  const SE3 T_map_odom = frames_.T_map_odom(), T_map_base = T_map_odom * pose.T_odom_base;
  write_changes(frames_.changes());
  file_.write(Topic::kTf, now_,
              tf_message({{{frame.time, kMapFrame}, kOdomFrame, T_map_odom},
                          {{frame.time, kOdomFrame}, kBaseFrame, pose.T_odom_base}}));
  file_.write(Topic::kPose, now_, pose_message({frame.time, kMapFrame}, T_map_base));
  if (!pose.covariance.isZero(0)) {
    file_.write(Topic::kPoseWithCovariance, now_,
                pose_with_covariance_message({frame.time, kMapFrame},
                                             {T_map_base, in_parent(pose.covariance, T_map_base)}));
    write_odometry(frame, pose);
  }
  recent_[frame.index] = pose;
  if (!newest_pose_ || newest_pose_->first <= frame.time) newest_pose_ = {frame.time, pose.T_odom_base};
}

// Only with all that a filter needs: zeros would be taken for certainty.
void PoseStream::write_odometry(const FrameRecord& frame, const KnownPose& pose) {
  const std::optional<RosTwist> twist = twist_at(frame.index, pose);
  if (!twist) return;
  file_.write(Topic::kOdometry, now_,
              odometry_message({frame.time, kOdomFrame}, kBaseFrame,
                               {pose.T_odom_base, in_parent(pose.covariance, pose.T_odom_base)}, *twist));
}

// From the pose before: T_k = T_k-1 exp(dt velocity). With errors e of both in their own axes, that of dt
// velocity is e_k - Ad(exp(-dt velocity)) e_k-1.
std::optional<RosTwist> PoseStream::twist_at(int frame_index, const KnownPose& pose) const {
  auto before = recent_.lower_bound(frame_index);
  if (before == recent_.begin()) return std::nullopt;
  const KnownPose& last = (--before)->second;
  const double dt = seconds_between(last.time, pose.time);
  if (last.segment != pose.segment || dt <= 0 || dt > kMaxStep_s || last.covariance.isZero(0))
    return std::nullopt;
  const SE3 step = last.T_odom_base.inverse() * pose.T_odom_base;
  const Matrix6d back = step.inverse().adjoint();
  RosTwist twist{step.log() / dt, (pose.covariance + back * last.covariance * back.transpose()) / (dt * dt)};
  const Eigen::Vector3d scale_error = frames_.scale_sigma() * twist.velocity.head<3>();
  twist.covariance.topLeftCorner<3, 3>() += scale_error * scale_error.transpose();
  return twist;
}

void PoseStream::forget_old() {
  if (recent_.size() > kKept) recent_.erase(recent_.begin());
  if (without_pose_.size() > kKept) without_pose_.erase(without_pose_.begin());
}

}  // namespace edgevo
