// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parameters of the odometry for a servo loop, equal to params/servo.yaml over the defaults.
#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

/// Parameters for a servo loop. The lens is not corrected, since a correction during a motion would move
/// taught goals. Relocalisation in a lost map, which holds the goals, is tried for ten seconds at 20 Hz while
/// the robot is stopped.
inline OdometryParams servo_odometry_params() {
  OdometryParams params;
  params.camera.refine = "none";
  params.recovery.max_frames = 200;
  return params;
}

}  // namespace edgevo
