// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace edgevo {

/// Standard deviation of the place of a corner that was followed from one image to another, pixels.
constexpr double kFollowedSigmaPx = 0.5;

/// A corner that is followed from image to image.
struct FollowedCorner {
  /// Ascends over the whole run; a lost corner's number is not used again.
  uint32_t id = 0;
  /// Viewing ray (x, y, 1), by the correction of the image.
  Eigen::Vector3d ray;
};

}  // namespace edgevo
