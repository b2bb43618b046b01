// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Light that changes while a scene lasts: from the sun that its world was built under to another one.
//
// The brightness of each surface, the sky and the haze pass from one light to the other, and the shadows that
// houses and trees cast on the ground give way to those of the other sun. Surfaces, depth and poses are those
// of the world: two lights differ in gray only.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace edgevo {

/// Shadows on the ground, as seen from above.
struct GroundShadow {
  /// Position of the first cell's middle, x and y of the scene, metres.
  Eigen::Vector2d corner = {0, 0};
  /// Side of a cell, metres.
  double cell_m = 0.1;
  /// Number of cells along x.
  int width = 0;
  /// Number of cells along y.
  int height = 0;
  /// Share of the sun that reaches each cell, 0 to 255, rows along x.
  std::vector<uint8_t> lit;
  /// Brightness of the ground where no sun reaches it, as a share of that in the sun.
  float shade = 1;

  /// Factor on the gray of the ground at x, y (metres), between the cells linear; 1 beyond the last ones.
  float factor(float x, float y) const;
};

/// One light on a world.
struct Light {
  /// Factor on the gain of each surface of the world; empty: 1.
  std::vector<float> gain = {};
  /// Factor on the whole image.
  float exposure = 1;
  /// Gray of the sky at the horizon, as Sky::gray.
  float sky_gray = 225;
  /// Haze, as Sky::haze_per_metre.
  float haze_per_metre = 0;
  /// Shadows on the ground.
  std::shared_ptr<const GroundShadow> shadow = {};
};

/// A light that takes the place of another.
struct LightChange {
  /// The light before.
  Light first;
  /// The light after.
  Light second;
  /// Time of the scene at which the change begins, seconds.
  double begins_s = 0;
  /// Duration of the change, seconds.
  double duration_s = 0;

  /// Share of the second light at a time of the scene, 0 to 1, smooth.
  double share(double seconds) const;
};

}  // namespace edgevo
