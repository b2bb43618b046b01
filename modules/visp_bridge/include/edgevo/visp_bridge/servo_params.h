#pragma once
// The parameters of the odometry that a servo loop wants, the same as params/servo.yaml over the defaults.
#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

/// The lens is left alone (a correction in the middle of a motion would move what was taught), and a lost map
/// is tried for ten seconds at 20 Hz: the robot stands still meanwhile, and what was taught is in that map.
inline OdometryParams servo_odometry_params() {
  OdometryParams params;
  params.camera.refine = "none";
  params.recovery.max_frames = 200;
  return params;
}

}  // namespace edgevo
