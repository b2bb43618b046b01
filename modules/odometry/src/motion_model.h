#pragma once
// The camera goes on as before: where the next frame is looked for, and how fast the camera moves while its
// image is taken.
#include <optional>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "frame_clock.h"
#include "steady_motion.h"

namespace edgevo {

class MotionModel {
 public:
  /// Of the last frame with a pose, against the present reference keyframe.
  const SE3& T_last_ref() const { return T_last_ref_; }
  /// Motion from one frame to the next, as last seen, tangent.
  Vector6d velocity() const { return velocity_.log(); }
  const SteadyMotion& steady() const { return steady_; }
  /// From the last frame with a pose to the one that began: 1 where none was lost or left out.
  int frames_since() const { return frames_since_; }
  /// Where the frame that began is, if the camera goes on as before.
  SE3 predict() const;
  /// Where it is looked for, best first.
  std::vector<SE3> starts() const;
  /// Motion a second of points in the camera frame, as foreseen; nothing where no time is known.
  std::optional<Vector6d> expected_twist() const;
  /// The same as measured, when the image of a new pose was taken: the motion since the last frame is that of
  /// half a frame ago, and half of its change comes on top. 0: not known.
  Vector6d twist(const SE3& T_cur_ref) const;

  /// Each frame, before anything is asked about it.
  void begin_frame(Timestamp time);
  /// The frame has a pose; after a gap the velocity is the mean over the gap. `held`: the usual step decided.
  void follow(const SE3& T_cur_ref, bool held = false);
  /// A new map: the frame is the reference, `motion` that since the frame before; nothing: not known.
  void restart(const std::optional<SE3>& motion);
  /// Another keyframe is the reference; T_old_new is the motion from the new one to the old one.
  void change_reference(const SE3& T_old_new) { T_last_ref_ = T_last_ref_ * T_old_new; }

 private:
  SE3 T_last_ref_, velocity_;
  SteadyMotion steady_;
  double velocity_s_ = 0;  // that the motion `velocity_` takes; 0: not known
  FrameClock clock_;
  FrameClock::Step newest_;   // to the frame that began
  int frames_since_ = 0;      // from the last frame with a pose to it
  double seconds_since_ = 0;  // 0: not known
};

}  // namespace edgevo
