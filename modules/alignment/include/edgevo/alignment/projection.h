// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Projection of a point with inverse depth into another camera, with its derivatives.
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Lower bound of Y_z = z_target / z_host: nearer points are not projected.
constexpr double kMinProjectedDepth = 1e-3;

/// p' = pi(Y), Y = R x + rho t (the point in the target camera, times rho), Eq. (pointproj).
struct Projection {
  /// Whether the point lies in front of the target camera.
  bool valid = false;
  /// Projected position, pixels of the target image.
  Eigen::Vector2d px;
  /// Point in the target camera times the host's inverse depth: R x + rho t.
  Eigen::Vector3d Y;
};

/// Projects the point with the viewing `ray` (x, y, 1) and the inverse depth `idepth` in its host camera;
/// (R, t) is host to target. Invalid if Y_z <= kMinProjectedDepth.
inline Projection project(const Pinhole& camera, const Eigen::Matrix3d& R, const Eigen::Vector3d& t,
                          const Eigen::Vector3d& ray, double idepth) {
  Projection p;
  p.Y = R * ray + idepth * t;
  if (!(p.Y.z() > kMinProjectedDepth)) return p;
  p.px = camera.project(p.Y);
  p.valid = true;
  return p;
}

/// Jacobian d pi / d Y (2x3).
inline Eigen::Matrix<double, 2, 3> projection_jacobian(const Pinhole& camera, const Eigen::Vector3d& Y) {
  const double iz = 1.0 / Y.z();
  Eigen::Matrix<double, 2, 3> J;
  J << camera.fx * iz, 0, -camera.fx * Y.x() * iz * iz, 0, camera.fy * iz, -camera.fy * Y.y() * iz * iz;
  return J;
}

/// Jacobian d p' / d xi (2x6) for T <- exp(xi) T:  J_pi [rho I | -[Y]x].
inline Eigen::Matrix<double, 2, 6> pose_jacobian(const Pinhole& camera, const Eigen::Vector3d& Y,
                                                 double idepth) {
  const double iz = 1.0 / Y.z(), x = Y.x() * iz, y = Y.y() * iz;
  const double a = idepth * iz;
  Eigen::Matrix<double, 2, 6> J;
  J << camera.fx * a, 0, -camera.fx * a * x, -camera.fx * x * y, camera.fx * (1 + x * x), -camera.fx * y,  //
      0, camera.fy * a, -camera.fy * a * y, -camera.fy * (1 + y * y), camera.fy * x * y, camera.fy * x;
  return J;
}

}  // namespace edgevo
