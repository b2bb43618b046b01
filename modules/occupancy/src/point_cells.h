// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Neighbour search: the points of a map, sorted into cubes.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace edgevo {

/// Points that can be searched by position.
class PointCells {
 public:
  /// `cell`: edge of a cube, > 0; the largest radius of a search.
  explicit PointCells(double cell) : cell_(cell) {}

  /// Adds a finite point, at most 10^15 cubes from the origin.
  void add(const Eigen::Vector3d& p);
  /// Whether at least `count` points lie within `radius` (at most the edge of a cube) of p, including a point
  /// at p itself. Cost: at most the points in the 27 cubes around p.
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
