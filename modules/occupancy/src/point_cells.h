#pragma once
// Are there other points near a place? The points of a map, sorted into cubes.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace edgevo {

class PointCells {
 public:
  /// Edge of a cube, > 0: the largest radius that can be asked for.
  explicit PointCells(double cell) : cell_(cell) {}

  /// A finite point, not farther from the origin than some 10^15 cubes.
  void add(const Eigen::Vector3d& p);
  /// Whether `count` points or more lie within `radius` (at most the edge of a cube) of p; a point at p
  /// itself counts. Cost: the points in the 27 cubes around p, at most.
  [[nodiscard]] bool has_within(const Eigen::Vector3d& p, double radius, int count) const;

 private:
  using Cell = std::array<int64_t, 3>;
  struct CellHash {
    // Primes of the usual hash of cells (Teschner et al. 2003).
    size_t operator()(const Cell& c) const {
      return size_t(c[0] * 73856093 ^ c[1] * 19349663 ^ c[2] * 83492791);
    }
  };
  Cell cell_of(const Eigen::Vector3d& p) const;

  double cell_;
  std::unordered_map<Cell, std::vector<Eigen::Vector3d>, CellHash> points_;
};

}  // namespace edgevo
