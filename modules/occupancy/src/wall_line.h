#pragma once
// Straight edges that may frame a wall: edges come in pieces, a frame is whole.
#include <Eigen/Core>
#include <vector>

namespace edgevo {

/// A straight line of an edge in the map's world.
struct WallLine {
  Eigen::Vector3d begin, end;
  int first = 0, last = 0;  ///< keyframes of the segment that saw it

  double length() const { return (end - begin).norm(); }
  Eigen::Vector3d direction() const { return (end - begin).normalized(); }  ///< unit, from begin to end
  double distance(const Eigen::Vector3d& p) const;                          ///< to the nearest place on it
};

/// |cos| of two directions that count as one: ten degrees.
constexpr double kParallel = 0.985;

/// Pieces that lie within `width` of one line of space, and leave no gap longer than `gap`, as one. `pieces`
/// and result are in the order of their first keyframes. Cost: pieces times those of the same keyframes.
std::vector<WallLine> joined(const std::vector<WallLine>& pieces, double width, double gap);

}  // namespace edgevo
