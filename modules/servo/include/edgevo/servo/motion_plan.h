// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motion of the camera before the servo loop, as if moved by hand: around the taught pose, so that a map
// grows; to the taught pose; away from it.
#include "edgevo/core/se3.h"

namespace edgevo {

/// Phases of the motion.
enum class Phase {
  /// Moved around the taught pose; ends there, at rest.
  kTeach,
  /// Moved from the taught pose to the start of the servo loop.
  kAway,
  /// Steered by the control law.
  kServo
};

/// The motion before the servo loop. Scene axes: simulation/world.h, metres.
struct MotionPlan {
  /// Pose at which the goal is taught, and pose at which the servo loop starts.
  SE3 T_scene_taught, T_scene_start;
  /// Durations of the first two phases.
  double teach_s = 0, away_s = 0;

  /// Phase at a time since the first image.
  Phase phase(double seconds) const;
  /// Pose at a time in the first two phases; continuous, with continuous velocity.
  SE3 T_scene_cam(double seconds) const;
};

/// Offset of a camera that is moved around by hand from where that began, for a time since then: as in the
/// first phase, again and again.
SE3 moved_by_hand(double seconds);
/// Pose on the smooth way between two, for a share of its time from 0 to 1.
SE3 on_the_way(const SE3& from, const SE3& to, double share);

/// Motion above the middle of the rendered desk. The taught pose is half a metre from the table top, looking
/// 60 degrees down; the start is 0.23 m and 21 degrees away for `seed` 1, and changes by up to a fifth for
/// other seeds.
MotionPlan plan_over_desk(uint64_t seed);

}  // namespace edgevo
