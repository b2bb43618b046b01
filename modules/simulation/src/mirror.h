// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The mirror image of a world.
#include <Eigen/Core>
#include <vector>

#include "edgevo/simulation/world.h"

namespace edgevo {

/// An upright plane.
struct UprightPlane {
  /// A point of it, x and y in metres, and its normal, a unit vector.
  Eigen::Vector2d point, normal;
};

/// Makes a world that is its own mirror image: removes what lies beyond the plane, on the side to which its
/// normal points, and adds the mirror image of the rest, textures included. A surface that crosses the plane
/// ends there if one of its sides is along the normal and the other one in the plane; others cross their
/// mirror image.
void add_mirror_image(const UprightPlane& plane, std::vector<Surface>* surfaces);

}  // namespace edgevo
