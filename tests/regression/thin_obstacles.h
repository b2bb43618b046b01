// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Poles, railings and other bars of a rendered scene, and how much of each is in a map.
#include <octomap/OcTree.h>

#include <ostream>
#include <utility>
#include <vector>

#include "edgevo/simulation/world.h"
#include "true_scene.h"

namespace edgevo::test {

/// A free-standing bar, 5 to 15 cm thick and at least half a metre long; kerbs and pipes on walls do not
/// count. Metres, scene frame.
struct ThinObstacle {
  /// Ends of the axis.
  Eigen::Vector3d begin, end;
  /// Largest extent across the axis.
  double thickness = 0;
};

/// Thin obstacles of a scene: long, narrow surfaces, merged where they lie side by side.
std::vector<ThinObstacle> thin_obstacles(const World& world);

/// Coverage of the thin obstacles by an octree, for those of which three keyframes saw at least half a metre.
struct ThinFigures {
  /// Numbers of observed obstacles and of upright ones (poles) among them.
  int obstacles = 0, upright = 0;
  /// Numbers of those that are occupied over at least 80 % of their observed length.
  int occupied = 0, upright_occupied = 0;
  /// Observed length and the occupied part of it, metres.
  double length = 0, occupied_length = 0;
  /// Occupied share of the observed length of each obstacle, 0 to 1.
  std::vector<std::pair<ThinObstacle, double>> shares;
};
std::ostream& operator<<(std::ostream& out, const ThinFigures& figures);
/// Evaluates an octree up to `range` metres from the cameras.
ThinFigures evaluate_thin(const std::vector<ThinObstacle>& obstacles, const TrueScene& truth,
                          const octomap::OcTree& tree, double range);

}  // namespace edgevo::test
