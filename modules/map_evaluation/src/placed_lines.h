// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The lines of a map, put into its scene, and drawn into views of it.
#include <vector>

#include "edgevo/core/depth_source.h"
#include "edgevo/core/records.h"
#include "edgevo/simulation/scene.h"

namespace edgevo {

/// A piece of a line between two neighbouring vertices, scene axes, metres.
struct PlacedPiece {
  Eigen::Vector3d a, b;
  DepthSource source;
};

/// A map in its scene.
struct PlacedLines {
  std::vector<PlacedPiece> pieces;
  double metres_per_unit = 1;
  /// Index of the last keyframe's frame.
  int last_frame = 0;
};

/// Puts each keyframe with its lines at its true pose. Throws InputError: too few keyframes, no motion.
PlacedLines place_lines(const Run& map, const Scene& scene);

/// A pixel of a line in a view.
struct DrawnPixel {
  Eigen::Vector2d px;
  /// Unit normal of the line in the view.
  Eigen::Vector2d normal;
  /// Metres.
  double depth = 0;
  /// Index into PlacedLines::pieces.
  size_t piece = 0;
};
/// Draws the lines into a view, one entry for each pixel of their length.
std::vector<DrawnPixel> draw_lines(const PlacedLines& lines, const Pinhole& pinhole, const SE3& T_scene_cam);

}  // namespace edgevo
