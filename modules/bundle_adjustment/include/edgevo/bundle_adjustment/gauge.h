#pragma once
// What fixes the scale of an adjustment that nothing measures: the length of a baseline, as a prior.
#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// A prior that holds the pose `last_id` along the way from the first camera to it, to 1e-4 of the way's
/// length, and leaves it free otherwise; `T_first_world` is to be held by BaPose::fixed. Moving the last
/// camera along the way changes its translation by the unit vector of it. A way of no length has no
/// direction, and then the prior says nothing at all.
BaPrior hold_baseline(const SE3& T_first_world, const SE3& T_last_world, int last_id);

}  // namespace edgevo::ba
