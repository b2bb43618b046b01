// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How far the path of the keyframes can be off: what a place that is seen again may contradict.
#include <optional>
#include <vector>

#include "edgevo/core/angle.h"
#include "edgevo/core/sim3.h"

namespace edgevo {

/// Standard deviation of the logarithm of the unit, from one keyframe to the next, a random walk: 1 to 2 %
/// over forty metres of drives with a keyframe a metre.
inline constexpr double kUnitDrift = 0.002;
/// Of the translation of a step from keyframe to keyframe, beyond what the adjustment knows: a share of its
/// length.
inline constexpr double kStepShare = 0.01;
/// The least of it, in the unit of the map.
inline constexpr double kLeastStep = 0.002;
/// The same of its rotation, radians.
inline constexpr double kStepRotation = rad(0.1);

/// Covariance of xi in T_a_b <- exp(xi) T_a_b, for the motion between keyframes that follow one another.
/// `adjusted`: the covariance that the adjustment of the window left, if known.
Matrix7d step_covariance(const SE3& T_a_b, const std::optional<Matrix6d>& adjusted);

/// A step of a path.
struct PathStep {
  /// Pose of its end in the frame of its beginning.
  SE3 T_a_b;
  /// As `adjusted` of step_covariance().
  std::optional<Matrix6d> adjusted;
};
/// Covariance of the motion along a path of independent steps: of xi in T_first_last <- exp(xi) T_first_last.
Matrix7d path_covariance(const std::vector<PathStep>& steps);

}  // namespace edgevo
