// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A run in another unit of length, which may change from frame to frame: the path is chained again, each step
// with the mean of the factors at its ends.
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Changes the final poses with their covariances, and the keyframes with their depths, which move with their
/// frames. `factors`: new over old lengths, > 0, one for each frame.
void rescale_final(const std::vector<double>& factors, Run* run);
/// Changes the live poses.
void rescale_live(const std::vector<double>& factors, Run* run);

}  // namespace edgevo
