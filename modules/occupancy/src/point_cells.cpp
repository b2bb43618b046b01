// SPDX-License-Identifier: BSD-3-Clause
#include "point_cells.h"

#include <cmath>

namespace edgevo {

PointCells::Cell PointCells::cell_of(const Eigen::Vector3d& p) const {
  return {int64_t(std::floor(p.x() / cell_)), int64_t(std::floor(p.y() / cell_)),
          int64_t(std::floor(p.z() / cell_))};
}

void PointCells::add(const Eigen::Vector3d& p) { points_[cell_of(p)].push_back(p); }

bool PointCells::has_within(const Eigen::Vector3d& p, double radius, int count) const {
  const Cell middle = cell_of(p);
  // The middle cube first: most points have their neighbours there.
  for (const int64_t dx : {0, -1, 1})
    for (const int64_t dy : {0, -1, 1})
      for (const int64_t dz : {0, -1, 1}) {
        const auto cell = points_.find({middle[0] + dx, middle[1] + dy, middle[2] + dz});
        if (cell == points_.end()) continue;
        for (const Eigen::Vector3d& q : cell->second)
          if ((q - p).squaredNorm() <= radius * radius && --count <= 0) return true;
      }
  return count <= 0;
}

}  // namespace edgevo
