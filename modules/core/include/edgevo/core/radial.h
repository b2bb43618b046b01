// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the camera file has wrong about the lens: a residual radial distortion of one coefficient, or two, and
// the focal length.
//
//     x_file = x (1 + k1 r^2 + k2 r^4),   r = |x|
//
// x is the true normalised image point, x_file the one that the file's camera model yields. In forward motion
// an unmodelled k1 scales the measured expansion by (1 + 2 k1 r^2), and the scale of a monocular map grows or
// shrinks along the path; KITTI's rectified images have about +0.012. Valid where 1 + 3 k1 r^2 + 5 k2 r^4 >
// 0.
#include <Eigen/Core>

#include "edgevo/core/camera.h"

namespace edgevo {

/// x_file of the true point x, both in normalised coordinates.
inline Eigen::Vector2d add_radial(double k1, const Eigen::Vector2d& x, double k2 = 0) {
  const double r2 = x.squaredNorm();
  return x * (1.0 + (k1 + k2 * r2) * r2);
}

/// Derivative d x_file / d x.
inline Eigen::Matrix2d radial_jacobian(double k1, const Eigen::Vector2d& x, double k2 = 0) {
  const double r2 = x.squaredNorm();
  return (1.0 + (k1 + k2 * r2) * r2) * Eigen::Matrix2d::Identity() +
         2.0 * (k1 + 2.0 * k2 * r2) * x * x.transpose();
}

/// Derivative d x_file / d k1.
inline Eigen::Vector2d radial_derivative(const Eigen::Vector2d& x) { return x * x.squaredNorm(); }

/// Inverse of add_radial() by Newton's method on the radius, to 1e-12 where the model is valid.
inline Eigen::Vector2d remove_radial(double k1, const Eigen::Vector2d& x_file, double k2 = 0) {
  const double r_file = x_file.norm();
  if ((k1 == 0 && k2 == 0) || r_file == 0) return x_file;
  constexpr int kSteps = 8;           // each doubles the correct digits: more than enough
  constexpr double kMinSlope = 1e-3;  // d r_file / d r, 1 on the axis: below it the model folds over
  double r = r_file;
  for (int i = 0; i < kSteps; ++i) {
    const double r2 = r * r, slope = 1.0 + (3.0 * k1 + 5.0 * k2 * r2) * r2;
    if (!(slope > kMinSlope)) break;
    r -= (r * (1.0 + (k1 + k2 * r2) * r2) - r_file) / slope;
  }
  return x_file * (r / r_file);
}

/// x_file = (1 + focal) x (1 + k1 r^2) of the true point x, both in normalised coordinates.
inline Eigen::Vector2d add_lens(const ImageCorrection& lens, const Eigen::Vector2d& x) {
  return (1 + lens.focal) * add_radial(lens.k1, x);
}
/// Inverse of add_lens(), as exact as remove_radial().
inline Eigen::Vector2d remove_lens(const ImageCorrection& lens, const Eigen::Vector2d& x_file) {
  return remove_radial(lens.k1, x_file / (1 + lens.focal));
}

}  // namespace edgevo
