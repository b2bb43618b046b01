// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motion at constant velocity: predicts the next frame's pose, and how fast the camera moves while its image
// is taken.
#include <optional>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/tracking/frame_clock.h"

namespace edgevo {

/// How the camera turned, by another sensor.
struct KnownRotation {
  /// Rotation since the last frame with a pose: its vector, radians.
  Eigen::Vector3d since_last = Eigen::Vector3d::Zero();
  /// How fast points turn around the camera while the image is taken, rad/s in its axes.
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  /// How that changes during it, rad/s^2; 0: not known.
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();
};

/// Constant-velocity model of the camera's motion. A rotation that is known takes the place of that which is
/// extrapolated.
class MotionModel {
 public:
  /// Pose of the last frame with a pose, against the present reference keyframe.
  const SE3& T_last_ref() const { return T_last_ref_; }
  /// Last measured motion from one frame to the next, as a tangent vector.
  Vector6d velocity() const { return velocity_.log(); }
  /// Motion from the last frame with a pose to T_cur_ref.
  SE3 motion_to(const SE3& T_cur_ref) const { return T_cur_ref * T_last_ref_.inverse(); }
  /// Translation a frame from the last frame with a pose to T_cur_ref.
  double step_to(const SE3& T_cur_ref) const;
  /// Frame intervals from the last frame with a pose to the current one: 1 if none was lost or skipped.
  int frames_since() const { return frames_since_; }
  /// Pose of the current frame, predicted at constant velocity.
  SE3 predict() const;
  /// Poses to start tracking from, best first.
  std::vector<SE3> starts() const;
  /// Predicted twist of points in the camera frame, per second; nothing if no time is known.
  std::optional<Vector6d> expected_twist() const;
  /// KnownRotation::turning; 0: not known.
  Eigen::Vector3d turning() const { return known_ ? known_->turning : Eigen::Vector3d::Zero(); }
  /// Measured twist of points in the camera frame when the image of a new pose was taken, per second. The
  /// motion since the last frame is that of half a frame ago; half of its change is added. Zero: not known.
  Vector6d twist(const SE3& T_cur_ref) const;

  /// Must be called first for each frame.
  void begin_frame(Timestamp time);
  /// What another sensor says of the rotation, after begin_frame(); nothing: constant velocity gives it.
  void know_rotation(const std::optional<KnownRotation>& known) { known_ = known; }
  /// Whether another sensor says something of it.
  bool knows_rotation() const { return known_.has_value(); }
  /// Adopts a frame's pose; after a gap the velocity is the mean over the gap.
  void follow(const SE3& T_cur_ref);
  /// Starts over with a new map whose reference is the frame. `motion` is the motion since the frame before;
  /// nothing: not known.
  void restart(const std::optional<SE3>& motion);
  /// Goes back to an earlier frame: begin_frame() is called again for those after it.
  void set_clock_back(Timestamp time) { clock_.set_back(time); }
  /// Changes to another reference keyframe; T_old_new is the motion from the new one to the old one.
  void change_reference(const SE3& T_old_new) { T_last_ref_ = T_last_ref_ * T_old_new; }

 private:
  // The motion since the last frame with a pose, as tangent; `times` of the velocity.
  Vector6d motion_since(double times) const;

  SE3 T_last_ref_, velocity_;
  double velocity_s_ = 0;  // time of the motion `velocity_`; 0: not known
  FrameClock clock_;
  FrameClock::Step newest_;  // to the current frame
  std::optional<KnownRotation> known_;
  int frames_since_ = 0;      // from the last frame with a pose to the current one
  double seconds_since_ = 0;  // 0: not known
};

}  // namespace edgevo
