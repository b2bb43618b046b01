// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Distance of a position from the surfaces of a scene. Leaves and cars are cut-outs: only the opaque part of
// their surface exists.
#include "edgevo/simulation/world.h"

namespace edgevo::test {

/// Distance in metres from `p` to the existing part of a surface (a rectangle or triangle); for cut-outs, to
/// the centres of opaque squares of 5 cm. Returns `limit` where the surface is farther away.
double distance_to(const World& world, const Surface& s, const Eigen::Vector3d& p, double limit);

}  // namespace edgevo::test
