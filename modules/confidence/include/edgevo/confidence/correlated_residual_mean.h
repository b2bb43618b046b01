// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Mean of the smooth error of the last frames: one frame knows its variance to a factor of two, and it comes
// and goes with the motion of a hand, in a third of a second.
#include "edgevo/alignment/correlated_residual.h"

namespace edgevo {

/// Running mean, in which the newest of the frames weighs a tenth.
class CorrelatedResidualMean {
 public:
  /// Adds a frame. Returns the variance of the last frames, px^2, >= 0.
  double add(const CorrelatedResidual& frame) {
    constexpr double kNewestShare = 0.1;
    mean_.explained_px2 += kNewestShare * (frame.explained_px2 - mean_.explained_px2);
    mean_.per_px2 += kNewestShare * (frame.per_px2 - mean_.per_px2);
    return mean_.variance_px2();
  }

 private:
  CorrelatedResidual mean_;  // its covariance is not used
};

}  // namespace edgevo
