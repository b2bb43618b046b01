#pragma once
// How far a place is from what exists of a scene's surfaces: leaves and cars are cut out of theirs.
#include "edgevo/simulation/world.h"

namespace edgevo::test {

/// Metres from `p` to the part of a rectangle, or its half, that exists; of cut-outs to the middles of
/// squares of 5 cm. `limit`: not nearer than that.
double distance_to(const World& world, const Surface& s, const Eigen::Vector3d& p, double limit);

}  // namespace edgevo::test
