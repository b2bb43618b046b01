// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/patch_source.h"

#include <Eigen/LU>

namespace edgevo {

PatchSource patch_source(const FramePyramid& host, const Eigen::Vector2d& px_host,
                         const Eigen::Matrix2d& A_target_host) {
  // 0.6 squared. Half the area would be too early: the coarser level is more blurred than an image of its
  // size.
  constexpr double kMuchSmaller = 0.36;
  PatchSource source{&host.finest(), px_host, A_target_host};
  for (size_t l = 1; l < host.levels.size(); ++l) {
    if (!(source.A_target_host.determinant() < kMuchSmaller) || host.levels[l].gradient_magnitude.empty())
      break;
    source.level = &host.levels[l];
    source.px /= 2;  // x_l = x_0 / 2^l
    source.A_target_host *= 2;
  }
  return source;
}

}  // namespace edgevo
