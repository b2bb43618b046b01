// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact correspondences: the position in another view at which a pixel of one view is seen, from the depth of
// both views and the motion between them.
//
// For rendered frames and any others with depth and pose (such as Virtual KITTI, where moving objects are
// wrong). Depth images hold z in metres at pixel centres of the undistorted image, 0 for sky, which is
// infinitely far away.
//
// An edge often lies between two surfaces and belongs to the nearer one. If the depth around a sub-pixel
// position is that of one surface, its inverse depth is interpolated (exact on planes); otherwise the nearest
// surface within a pixel is used.
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Inverse depth (1/m, 0 for sky) of the surface that an edge at `px` belongs to. NaN outside the image.
double edge_idepth(const ImageView<float>& depth, const Eigen::Vector2d& px);

/// The position of a point of one view in another.
struct Correspondence {
  /// Inverse depth of the point in the first view, 1/m; 0 for sky.
  double idepth = 0;
  /// True if the point is in front of the second camera and inside its image; px is set only then.
  bool in_view = false;
  /// True if the point is in view and not occluded.
  bool visible = false;
  /// Position in the second view, pixels, sub-pixel.
  Eigen::Vector2d px;
};

/// Two views of one scene.
struct ViewPair {
  /// Camera of both views.
  Pinhole pinhole;
  /// Depth images of the first and the second view.
  ImageView<float> depth_from, depth_to;
  /// Exact motion, metres.
  SE3 T_to_from;
};

/// The position at which `px` of the first view is seen. It is visible if one of the pixels around that
/// position has the expected depth to within `tolerance` (relative).
Correspondence find_correspondence(const ViewPair& views, const Eigen::Vector2d& px, double tolerance = 0.02);

}  // namespace edgevo
