// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/camera_models.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kRightAngle = 1.5707963267948966;  // radians

// Newton's method on the lens model, normalised coordinates.
constexpr int kMostSteps = 30;  // more than any point within the model's range needs
// Step at which it has converged: the documented 1e-12, with a margin.
constexpr double kErrorSquare = 1e-26;
// Determinant of the derivative, 1 on the axis; below it the point is beyond the model's range.
constexpr double kFoldedOver = 1e-6;
// Slope of the distortion, 1 on the axis, at which the range ends: below it the inverse would amplify errors
// of pixels more than a thousandfold.
constexpr double kLeastSlope = 1e-3;
// Halvings of an interval that exhaust the digits of a double.
constexpr int kHalvings = 60;

Eigen::Vector2d normalised(const Intrinsics& c, const Eigen::Vector2d& px) {
  return {(px.x() - c.cx) / c.fx, (px.y() - c.cy) / c.fy};
}

Eigen::Vector2d pixel(const Intrinsics& c, const Eigen::Vector2d& x) {
  return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy};
}

// d (X/Z, Y/Z) / d (X, Y, Z).
PixelJacobian perspective_jacobian(const Eigen::Vector3d& p) {
  PixelJacobian J;
  J << 1 / p.z(), 0, -p.x() / (p.z() * p.z()), 0, 1 / p.z(), -p.y() / (p.z() * p.z());
  return J;
}

// ---- plumb-bob, normalised coordinates ----

Eigen::Vector2d distort(const Distortion& d, const Eigen::Vector2d& x) {
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double xy = x.x() * x.y();
  return {x.x() * radial + 2.0 * d.p1 * xy + d.p2 * (r2 + 2.0 * x.x() * x.x()),
          x.y() * radial + d.p1 * (r2 + 2.0 * x.y() * x.y()) + 2.0 * d.p2 * xy};
}

// d distort / d x, symmetric.
Eigen::Matrix2d distortion_jacobian(const Distortion& d, const Eigen::Vector2d& p) {
  const double r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double dradial = 2.0 * (d.k1 + r2 * (2.0 * d.k2 + r2 * 3.0 * d.k3));  // d radial / d (r2/2)
  Eigen::Matrix2d J;
  J(0, 0) = radial + p.x() * p.x() * dradial + 2.0 * d.p1 * p.y() + 6.0 * d.p2 * p.x();
  J(0, 1) = p.x() * p.y() * dradial + 2.0 * d.p1 * p.x() + 2.0 * d.p2 * p.y();
  J(1, 0) = J(0, 1);
  J(1, 1) = radial + p.y() * p.y() * dradial + 6.0 * d.p1 * p.y() + 2.0 * d.p2 * p.x();
  return J;
}

// Lower bound of the eigenvalues of distortion_jacobian() over the disc of radius r: the least slope of the
// radial polynomial in it, less the most that the tangential terms may take away there. The Jacobian is
// symmetric, and a map whose symmetric Jacobian is positive definite on a convex set is one-to-one on it.
double least_slope(const Distortion& d, double r) {
  const double a = 3 * d.k1, b = 5 * d.k2, c = 7 * d.k3, t_end = r * r;
  const auto slope = [&](double t) { return 1 + t * (a + t * (b + t * c)); };
  double least = std::min(1.0, slope(t_end));
  // Its extrema: 3c t^2 + 2b t + a = 0, in the form that also holds for c near 0.
  const double root = std::sqrt(std::max(0.0, b * b - 3 * a * c));
  for (const double sign : {-1.0, 1.0}) {
    const double q = -b + sign * root;
    for (const double t : {q / (3 * c), a / q})
      if (t > 0 && t < t_end) least = std::min(least, slope(t));
  }
  return least - 6 * std::hypot(d.p1, d.p2) * r;
}

// NaN where the radius is infinite compares as false.
bool is_in_range(const Distortion& d, double r) { return least_slope(d, r) >= kLeastSlope; }

// Newton's method from `start`. Nullopt if it does not converge within the range of the model.
std::optional<Eigen::Vector2d> solve(const Distortion& d, const Eigen::Vector2d& x_d,
                                     const Eigen::Vector2d& start) {
  const double size = std::max(1.0, x_d.norm());
  Eigen::Vector2d x = start;
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector2d error = distort(d, x) - x_d;
    if (error.squaredNorm() < kErrorSquare * size * size)
      return is_in_range(d, x.norm()) ? std::optional<Eigen::Vector2d>(x) : std::nullopt;
    const Eigen::Matrix2d J = distortion_jacobian(d, x);
    if (!(J.determinant() > kFoldedOver)) return std::nullopt;
    x -= J.inverse() * error;
  }
  return std::nullopt;
}

// The point in the direction of x_d whose distortion, but for the tangential part, is x_d.
Eigen::Vector2d without_radial(const Distortion& d, const Eigen::Vector2d& x_d, double max_angle) {
  const double r_d = x_d.norm();
  double low = 0, high = max_angle;
  for (int i = 0; i < kHalvings; ++i) {
    const double angle = 0.5 * (low + high), r = std::tan(angle), r2 = r * r;
    (r * (1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3))) < r_d ? low : high) = angle;
  }
  return r_d > 0 ? Eigen::Vector2d(x_d * (std::tan(low) / r_d)) : x_d;
}

}  // namespace

std::optional<Eigen::Vector2d> PinholeModel::project(const Eigen::Vector3d& ray) const {
  if (!(ray.z() > 0)) return std::nullopt;
  return pixel(*this, {ray.x() / ray.z(), ray.y() / ray.z()});
}

std::optional<Eigen::Vector3d> PinholeModel::unproject(const Eigen::Vector2d& px) const {
  const Eigen::Vector2d x = normalised(*this, px);
  return Eigen::Vector3d(x.x(), x.y(), 1);
}

PixelJacobian PinholeModel::jacobian(const Eigen::Vector3d& ray) const {
  return Eigen::Vector2d(fx, fy).asDiagonal() * perspective_jacobian(ray);
}

double PinholeModel::max_angle() const { return kRightAngle; }

std::optional<Eigen::Vector2d> PlumbBobModel::project(const Eigen::Vector3d& ray) const {
  if (!(ray.z() > 0)) return std::nullopt;
  return pixel(*this, distort(distortion, {ray.x() / ray.z(), ray.y() / ray.z()}));
}

std::optional<Eigen::Vector3d> PlumbBobModel::unproject(const Eigen::Vector2d& px) const {
  const Eigen::Vector2d x_d = normalised(*this, px);
  auto x = solve(distortion, x_d, x_d);
  if (!x) x = solve(distortion, x_d, without_radial(distortion, x_d, max_angle()));
  if (!x) return std::nullopt;
  return Eigen::Vector3d(x->x(), x->y(), 1);
}

PixelJacobian PlumbBobModel::jacobian(const Eigen::Vector3d& ray) const {
  const Eigen::Vector2d x(ray.x() / ray.z(), ray.y() / ray.z());
  return Eigen::Vector2d(fx, fy).asDiagonal() * distortion_jacobian(distortion, x) *
         perspective_jacobian(ray);
}

double PlumbBobModel::max_angle() const {
  double low = 0, high = kRightAngle;
  for (int i = 0; i < kHalvings; ++i) {
    const double angle = 0.5 * (low + high);
    (is_in_range(distortion, std::tan(angle)) ? low : high) = angle;
  }
  return low;
}

}  // namespace edgevo
