#pragma once
// Poles, railings and other bars of a rendered scene, and how much of each a map holds.
#include <octomap/OcTree.h>

#include <ostream>
#include <utility>
#include <vector>

#include "edgevo/simulation/world.h"
#include "true_scene.h"

namespace edgevo::test {

/// A bar 5 to 15 cm thick, half a metre long or more, that stands free: kerbs and pipes on walls are none.
/// Metres, frame of the scene.
struct ThinObstacle {
  Eigen::Vector3d begin, end;  ///< of its axis
  double thickness = 0;        ///< the larger one
};

/// Surfaces that are long and narrow, put together where they lie side by side.
std::vector<ThinObstacle> thin_obstacles(const World& world);

/// How an octree shows the thin obstacles of which three keyframes saw half a metre or more.
struct ThinFigures {
  int obstacles = 0, upright = 0;                       ///< that were seen; upright: of them, poles
  int occupied = 0, upright_occupied = 0;               ///< over 80 % of their seen length
  double length = 0, occupied_length = 0;               ///< metres seen, and of them occupied
  std::vector<std::pair<ThinObstacle, double>> shares;  ///< of each
};
std::ostream& operator<<(std::ostream& out, const ThinFigures& figures);
ThinFigures judge_thin(const std::vector<ThinObstacle>& obstacles, const TrueScene& truth,
                       const octomap::OcTree& tree, double range);

}  // namespace edgevo::test
