// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What moves by itself in one frame: no part of the scene.
#include <Eigen/Core>
#include <set>
#include <utility>
#include <vector>

namespace edgevo {

/// Rectangle in the finest level of an image, pixels.
struct ImageBox {
  /// Sides; left < right, top < bottom.
  double left = 0, top = 0, right = 0, bottom = 0;
  /// Whether a pixel lies in the rectangle or within `margin` pixels of it.
  bool contains(const Eigen::Vector2d& px, double margin = 0) const {
    return px.x() > left - margin && px.x() < right + margin && px.y() > top - margin &&
           px.y() < bottom + margin;
  }
};

/// Moving bodies in a frame.
struct MovingAreas {
  /// Where they are seen.
  std::vector<ImageBox> boxes;
  /// Points of the map that were made on them: host keyframe and edge pixel there.
  std::set<std::pair<int, int>> points;

  /// Whether nothing moves.
  bool empty() const { return boxes.empty() && points.empty(); }
  /// Whether a pixel lies on a body, or within a few pixels of one.
  bool cover(const Eigen::Vector2d& px) const {
    constexpr double kMarginPx = 4;
    for (const ImageBox& box : boxes)
      if (box.contains(px, kMarginPx)) return true;
    return false;
  }
  /// Whether the point of the map was made on a body.
  bool made(int host_keyframe, int host_pixel) const { return points.count({host_keyframe, host_pixel}) > 0; }
};

}  // namespace edgevo
