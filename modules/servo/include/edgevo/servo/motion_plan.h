#pragma once
// Where the camera is moved by hand before a servo loop takes over: about the taught pose, so that a map
// grows; to the taught pose; away.
#include "edgevo/core/se3.h"

namespace edgevo {

/// Who moves the camera.
enum class Phase {
  kTeach,  ///< about the taught pose; ends at it, at rest
  kAway,   ///< from the taught pose to where the servo loop starts
  kServo   ///< steered by the control law
};

/// The motion before the servo loop. Scene axes: simulation/world.h, metres.
struct MotionPlan {
  SE3 T_scene_taught, T_scene_start;  ///< where the goal is taught, and where the servo loop starts
  double teach_s = 0, away_s = 0;  ///< how long the two take

  Phase phase(double seconds) const;  ///< at a time since the first image
  /// Pose at a time of the first two phases; continuous, with continuous velocity.
  SE3 T_scene_cam(double seconds) const;
};

/// Over the middle of the rendered desk: taught pose half a metre from its top, looking 60 degrees down;
/// start 0.23 m and 21 degrees away. `seed` 1 is that; others move the start by up to a fifth.
MotionPlan plan_over_desk(uint64_t seed);

}  // namespace edgevo
