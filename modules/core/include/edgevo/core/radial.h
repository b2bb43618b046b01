#pragma once
// Residual radial distortion: what a camera file does not know about its lens, one coefficient.
//
//     x_file = x (1 + k1 r^2),   r = |x|
//
// x is the true normalised image point, x_file the one that the file's camera model yields. In forward motion an unknown k1 makes
// the measured expansion wrong by (1 + 2 k1 r^2) and the scale of a monocular map grows or shrinks all along the drive; KITTI's
// rectified images carry about +0.012. Valid where 1 + 3 k1 r^2 > 0.
#include <Eigen/Core>

namespace edgevo {

/// x_file of a true x, both normalised.
inline Eigen::Vector2d add_radial(double k1, const Eigen::Vector2d& x) { return x * (1.0 + k1 * x.squaredNorm()); }

/// d x_file / d x.
inline Eigen::Matrix2d radial_jacobian(double k1, const Eigen::Vector2d& x) {
  return (1.0 + k1 * x.squaredNorm()) * Eigen::Matrix2d::Identity() + 2.0 * k1 * x * x.transpose();
}

/// d x_file / d k1.
inline Eigen::Vector2d radial_derivative(const Eigen::Vector2d& x) { return x * x.squaredNorm(); }

/// Inverse of add_radial, to 1e-12 where it is valid: Newton's method on the radius.
inline Eigen::Vector2d remove_radial(double k1, const Eigen::Vector2d& x_file) {
  const double r_file = x_file.norm();
  if (k1 == 0 || r_file == 0) return x_file;
  constexpr int kSteps = 8;             // each doubles the digits: more than it takes
  constexpr double kLeastSlope = 1e-3;  // of r_file over r, 1 on the axis: beyond it the lens folds over
  double r = r_file;
  for (int i = 0; i < kSteps; ++i) {
    const double slope = 1.0 + 3.0 * k1 * r * r;
    if (!(slope > kLeastSlope)) break;
    r -= (r * (1.0 + k1 * r * r) - r_file) / slope;
  }
  return x_file * (r / r_file);
}

}  // namespace edgevo
