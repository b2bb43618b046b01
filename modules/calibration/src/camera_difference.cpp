// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/camera_difference.h"

#include <algorithm>
#include <limits>

namespace edgevo {

double largest_difference_px(const Camera& a, const Camera& b) {
  constexpr int kCells = 8;
  double largest = 0;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const Eigen::Vector2d px(i * (a.width - 1.0) / kCells, j * (a.height - 1.0) / kCells);
      const auto ray = a.unproject(px);
      const auto other = b.unproject(px);
      if (!ray && !other) continue;
      const auto shown = ray && other ? b.project(*ray) : std::nullopt;
      largest = std::max(largest, shown ? (*shown - px).norm() : std::numeric_limits<double>::infinity());
    }
  return largest;
}

}  // namespace edgevo
