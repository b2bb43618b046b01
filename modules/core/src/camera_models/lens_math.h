// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the lens models share. Normalised coordinates: pixels less the principal point, over the focal length.
#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "edgevo/core/camera_models.h"

namespace edgevo {

/// Radians.
constexpr double kRightAngle = 1.5707963267948966, kHalfTurn = 3.141592653589793;
/// Slope of a distortion, 1 on the axis, at which its range ends: below it the inverse would amplify errors
/// of pixels more than a thousandfold.
constexpr double kMinSlope = 1e-3;
/// Halvings of an interval that exhaust the digits of a double.
constexpr int kHalvings = 60;

/// Normalised coordinates of a pixel.
inline Eigen::Vector2d normalised(const Intrinsics& c, const Eigen::Vector2d& px) {
  return {(px.x() - c.cx) / c.fx, (px.y() - c.cy) / c.fy};
}

/// Pixel of normalised coordinates.
inline Eigen::Vector2d pixel(const Intrinsics& c, const Eigen::Vector2d& x) {
  return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy};
}

/// Whether the ray has no direction in the image: the optical axis backwards, or no ray at all.
inline bool is_backwards(const Eigen::Vector3d& ray) { return ray.head<2>().norm() == 0 && !(ray.z() > 0); }

/// d (X/Z, Y/Z) / d (X, Y, Z).
inline PixelJacobian perspective_jacobian(const Eigen::Vector3d& p) {
  PixelJacobian J;
  J << 1 / p.z(), 0, -p.x() / (p.z() * p.z()), 0, 1 / p.z(), -p.y() / (p.z() * p.z());
  return J;
}

/// Largest x in [low, high] up to which `holds`, which changes once; `low` if it never holds.
template <class Holds>
double last_that_holds(double low, double high, const Holds& holds) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

/// Newton's method on distort(x) = x_d from `start`. Nullopt where it does not converge, or only to a point
/// that is not `in_range`.
template <class Distort, class Jacobian, class InRange>
std::optional<Eigen::Vector2d> solve_distortion(const Eigen::Vector2d& x_d, const Eigen::Vector2d& start,
                                                const Distort& distort, const Jacobian& jacobian,
                                                const InRange& in_range) {
  constexpr int kMaxSteps = 30;           // more than any point within a model's range needs
  constexpr double kErrorSquare = 1e-26;  // the documented 1e-12, with a margin
  constexpr double kFoldedOver = 1e-6;    // of the determinant, 1 on the axis
  const double size = std::max(1.0, x_d.norm());
  Eigen::Vector2d x = start;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Eigen::Vector2d error = distort(x) - x_d;
    if (error.squaredNorm() < kErrorSquare * size * size)
      return in_range(x) ? std::optional<Eigen::Vector2d>(x) : std::nullopt;
    const Eigen::Matrix2d J = jacobian(x);
    if (!(J.determinant() > kFoldedOver)) return std::nullopt;
    x -= J.inverse() * error;
  }
  return std::nullopt;
}

}  // namespace edgevo
