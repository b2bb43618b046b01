// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How well turns carry the unit of length over: in a pure rotation new points have their depths by what the
// camera moved meanwhile, and if that was little against the error of its position, an error that all of them
// share is their error of scale. Each keyframe says by how much (AdjustmentEvidence::unit_variance); it adds
// up.
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// A turn that leaves the unit of length after it uncertain.
struct PureRotation {
  /// Indices in the source of the first and the last frame.
  int first_frame = 0, last_frame = 0;
  /// Angle by which the view turned, radians, from keyframe to keyframe.
  double angle_rad = 0;
  /// Standard deviation of the logarithm of the unit after it over that before.
  double sigma = 0;
};

/// The turns of a run after which the unit is known to no better than 5 %, in time order; none over which a
/// link that holds leads. Cost: linear.
std::vector<PureRotation> pure_rotations(const Run& run);

/// "frames 141 to 224: a pure rotation by 270 degrees: the unit of length after it is that before to 11
/// %".
std::string to_string(const PureRotation& turn);

}  // namespace edgevo
