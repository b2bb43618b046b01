// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A corner of the chain (corner_chain.h) as it is expected in an image: its pixel, and how that depends on
// the pose of the camera and on the depth of the corner.
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Standard deviation of a followed corner, pixels, in each direction.
constexpr double kCornerNoisePx = 0.4;
/// Whitened error above which a corner disagrees.
constexpr double kMaxCornerError = 3;
/// Least depth of a corner, over that in the anchor.
constexpr double kLeastCornerDepth = 0.05;

/// What is known of a corner, and where an image shows it.
struct CornerInImage {
  /// Viewing ray in the anchor, z = 1.
  Eigen::Vector3d ray;
  /// Inverse depth in the anchor and its variance.
  double idepth = 0, variance = 0;
  /// Pixel in the image.
  Eigen::Vector2d px;
};

/// A corner predicted in an image.
struct CornerSight {
  /// Whether it lies before the camera; if not, all else is unused.
  bool is_visible = false;
  /// Inverse depth in the anchor, given the image.
  double idepth = 0;
  /// Pixel at the filtered depth.
  Eigen::Vector2d px;
  /// Derivative of the pixel by the inverse depth.
  Eigen::Vector2d slope;
  /// Derivative of the pixel by xi in T_cam_anchor <- exp(xi) T_cam_anchor at a fixed depth.
  Eigen::Matrix<double, 2, 6> J;
  /// Inverse covariance of the pixel, with the uncertainty of the depth.
  Eigen::Matrix2d weight;
};

/// The corner seen from T_cam_anchor. The depth is the likeliest one given the filter and this image, or a
/// step would come out too short: errors of fixed depths dilute it, by the square of their relative standard
/// deviation.
CornerSight predict_corner(const CornerInImage& corner, const SE3& T_cam_anchor, const Pinhole& pinhole);

}  // namespace edgevo
