#pragma once
// Exact correspondences: where a pixel of one view is seen in another, by the depth of both views and the motion between them.
//
// For rendered frames and anything else with depth and pose (Virtual KITTI, for instance; there, what moves by itself is wrong).
// Depth images hold z in metres at pixel centres of the undistorted image, 0 for sky, which is infinitely far away.
//
// An edge often lies between two surfaces and belongs to the nearer one. Where the depth around a sub-pixel position is one
// surface, its inverse depth is interpolated (exact on planes); where it is not, the nearest surface within a pixel is taken.
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Inverse depth (1/m, 0 for sky) of the surface that an edge at `px` belongs to. NaN outside the image.
double edge_idepth(const ImageView<float>& depth, const Eigen::Vector2d& px);

/// Where a point of one view is in another.
struct Correspondence {
  double idepth = 0;     ///< of the point, in the first view; 0 for sky
  bool in_view = false;  ///< in front of the second camera and inside its image; px is set only then
  bool visible = false;  ///< in view and not behind something nearer
  Eigen::Vector2d px;    ///< in the second view, sub-pixel
};

/// Two views of one scene.
struct ViewPair {
  Pinhole pinhole;  ///< of both
  ImageView<float> depth_from, depth_to;  ///< of the two views
  SE3 T_to_from;  ///< exact motion, metres
};

/// Where `px` of the first view is seen. Visible if one of the pixels around the position has the expected depth to within
/// `tolerance` (relative).
Correspondence find_correspondence(const ViewPair& views, const Eigen::Vector2d& px, double tolerance = 0.02);

}  // namespace edgevo
