// SPDX-License-Identifier: BSD-3-Clause
#include "plumb_bob.h"

#include <algorithm>
#include <cmath>

#include "lens_math.h"

namespace edgevo {
namespace {

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

// The point in the direction of x_d whose distortion, but for the tangential part, is x_d.
Eigen::Vector2d without_radial(const Distortion& d, const Eigen::Vector2d& x_d) {
  const double r_d = x_d.norm();
  if (!(r_d > 0)) return x_d;
  const double angle = last_that_holds(0, range_angle(d), [&](double a) {
    const double r = std::tan(a), r2 = r * r;
    return r * (1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3))) < r_d;
  });
  return x_d * (std::tan(angle) / r_d);
}

}  // namespace

Eigen::Vector2d distort(const Distortion& d, const Eigen::Vector2d& x) {
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double xy = x.x() * x.y();
  return {x.x() * radial + 2.0 * d.p1 * xy + d.p2 * (r2 + 2.0 * x.x() * x.x()),
          x.y() * radial + d.p1 * (r2 + 2.0 * x.y() * x.y()) + 2.0 * d.p2 * xy};
}

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

// NaN where the radius is infinite compares as false.
bool is_in_range(const Distortion& d, double radius) { return least_slope(d, radius) >= kMinSlope; }

double range_angle(const Distortion& d) {
  return last_that_holds(0, kRightAngle, [&](double angle) { return is_in_range(d, std::tan(angle)); });
}

std::optional<Eigen::Vector2d> undistort(const Distortion& d, const Eigen::Vector2d& x_d) {
  const auto solve = [&](const Eigen::Vector2d& start) {
    return solve_distortion(
        x_d, start, [&](const auto& x) { return distort(d, x); },
        [&](const auto& x) { return distortion_jacobian(d, x); },
        [&](const auto& x) { return is_in_range(d, x.norm()); });
  };
  const auto x = solve(x_d);
  return x ? x : solve(without_radial(d, x_d));
}

}  // namespace edgevo
