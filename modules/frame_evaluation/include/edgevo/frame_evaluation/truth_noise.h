// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Noise of a ground truth, estimated from itself: a camera moves smoothly from sample to sample, so the third
// differences of its positions (and those of its orientations) are mostly noise. White noise of standard
// deviation s per axis gives third differences of sqrt(20) s. A median over the samples ignores jumps.
//
// A camera that really jerks between two samples raises the estimate: it is an upper bound. For a truth
// without noise (a rendered scene) it is what the path's own third differences leave, micrometres.
//
// Errors that stay the same from sample to sample do not show: those of a filtered truth (GPS with inertial
// sensors) are larger. Then state what is known of them: larger_noise().
#include "edgevo/evaluation/figures.h"
#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// Standard deviations per axis of one true pose.
struct TruthNoise {
  /// Of the position, metres.
  double position_m = 0;
  /// Of the orientation, radians.
  double rotation_rad = 0;
};

/// Noise of `truth`; zero for fewer than eight samples. Cost: linear.
TruthNoise truth_noise(const Trajectory& truth);

/// The larger of each.
TruthNoise larger_noise(const TruthNoise& a, const TruthNoise& b);

}  // namespace edgevo
