// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gauge of an adjustment whose scale is not observable: a prior on the length of a baseline.
#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// Prior that fixes pose `last_id` along the baseline from the first camera to it, with a standard deviation
/// of 1e-4 of the baseline, and leaves the other directions free; the pose of `T_first_world` must be fixed
/// (BaPose::fixed). Without a baseline the prior has no information.
BaPrior fix_baseline(const SE3& T_first_world, const SE3& T_last_world, int last_id);

}  // namespace edgevo::ba
