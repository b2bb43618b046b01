#pragma once
// The camera goes on as before: where the next frame is looked for, and how fast the camera moves while its image is taken.
#include <optional>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "steady_motion.h"

namespace edgevo {

class MotionModel {
 public:
  /// Of the last frame with a pose, against the present reference keyframe.
  const SE3& T_last_ref() const { return T_last_ref_; }
  /// Motion from one frame to the next, as last seen, tangent.
  Vector6d velocity() const { return velocity_.log(); }
  const SteadyMotion& steady() const { return steady_; }
  /// Where the next frame is after one with a pose.
  SE3 predict() const { return velocity_ * T_last_ref_; }
  /// Where it is looked for, best first; after frames without a pose over the gap, too.
  std::vector<SE3> starts() const;
  /// Motion a second of points in the camera frame, as foreseen; nothing where no time is known.
  std::optional<Vector6d> expected_twist() const;
  /// The same as measured, when the image of a new pose was taken: the motion since the last frame is that of half a frame ago, and half of
  /// its change comes on top. 0: not known.
  Vector6d twist(Timestamp time, const SE3& T_cur_ref) const;

  /// A frame with a pose; after a gap the velocity is the mean over the gap. `held`: hold_steady() chose it.
  void follow(Timestamp time, const SE3& T_cur_ref, bool held = false);
  /// A frame without one.
  void miss() { ++missed_; }
  /// The gap is counted from here.
  void begin_gap() { missed_ = 0; }
  /// A new map: the last frame is the reference, `motion` that since the frame before, which took `seconds` (0: not known).
  void restart(Timestamp time, const SE3& motion, double seconds);
  /// Another keyframe is the reference; T_old_new is the motion from the new one to the old one.
  void change_reference(const SE3& T_old_new) { T_last_ref_ = T_last_ref_ * T_old_new; }

 private:
  static constexpr int kLongGap = 10;  // frames

  SE3 T_last_ref_, velocity_;
  SteadyMotion steady_;
  double velocity_s_ = 0;  // that the motion `velocity_` takes; 0: not known
  Timestamp time_;         // of T_last_ref_
  int missed_ = 0;         // frames since
};

}  // namespace edgevo
