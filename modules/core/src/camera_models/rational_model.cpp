// SPDX-License-Identifier: BSD-3-Clause
// Pinhole with rational distortion and thin prism.
#include <algorithm>

#include "lens_math.h"
#include "plumb_bob.h"

namespace edgevo {
namespace {

using Vector2d = Eigen::Vector2d;

// The radial factor and its derivative by r^2. NaN beyond a pole.
struct Radial {
  double factor, derivative;
};

Radial radial(const RationalDistortion& d, double r2) {
  const Distortion& n = d.plumb_bob;
  const double above = 1 + r2 * (n.k1 + r2 * (n.k2 + r2 * n.k3));
  const double below = 1 + r2 * (d.k4 + r2 * (d.k5 + r2 * d.k6));
  const double above_by = n.k1 + r2 * (2 * n.k2 + r2 * 3 * n.k3);
  const double below_by = d.k4 + r2 * (2 * d.k5 + r2 * 3 * d.k6);
  if (!(below > 0)) return {NAN, NAN};
  return {above / below, (above_by * below - above * below_by) / (below * below)};
}

Distortion tangential(const RationalDistortion& d) { return {0, 0, d.plumb_bob.p1, d.plumb_bob.p2, 0}; }

Vector2d distort(const RationalDistortion& d, const Vector2d& x) {
  const double r2 = x.squaredNorm();
  const Vector2d prism(r2 * (d.s1 + r2 * d.s2), r2 * (d.s3 + r2 * d.s4));
  return x * (radial(d, r2).factor - 1) + distort(tangential(d), x) + prism;
}

Eigen::Matrix2d distortion_jacobian(const RationalDistortion& d, const Vector2d& x) {
  const double r2 = x.squaredNorm();
  const Radial f = radial(d, r2);
  const Vector2d prism(2 * d.s1 + 4 * d.s2 * r2, 2 * d.s3 + 4 * d.s4 * r2);
  return (f.factor - 1) * Eigen::Matrix2d::Identity() + 2 * f.derivative * x * x.transpose() +
         distortion_jacobian(tangential(d), x) + prism * x.transpose();
}

// Slope of the radial part, less the most that the others may take away on the disc of this radius.
double slope(const RationalDistortion& d, double r) {
  const double r2 = r * r;
  const Radial f = radial(d, r2);
  const double others = 6 * std::hypot(d.plumb_bob.p1, d.plumb_bob.p2) + 2 * std::hypot(d.s1, d.s3) +
                        4 * std::hypot(d.s2, d.s4) * r2;
  return f.factor + 2 * r2 * f.derivative - others * r;
}

// Whether the image neither folds over nor runs to a pole here, with margins.
bool is_regular(const RationalDistortion& d, double angle) {
  const double s = slope(d, std::tan(angle));
  return s >= kMinSlope && s <= 1 / kMinSlope;
}

Vector2d without_radial(const RationalDistortion& d, const Vector2d& x_d, double max_angle) {
  const double r_d = x_d.norm();
  if (!(r_d > 0)) return x_d;
  const double angle = last_that_holds(0, max_angle, [&](double a) {
    const double r = std::tan(a);
    return r * radial(d, r * r).factor < r_d;
  });
  return x_d * (std::tan(angle) / r_d);
}

}  // namespace

std::optional<Vector2d> RationalModel::project(const Eigen::Vector3d& ray) const {
  if (!(ray.z() > 0)) return std::nullopt;
  const Vector2d x_d = distort(distortion, {ray.x() / ray.z(), ray.y() / ray.z()});
  if (!x_d.allFinite()) return std::nullopt;
  return pixel(*this, x_d);
}

std::optional<Eigen::Vector3d> RationalModel::unproject(const Vector2d& px) const {
  const Vector2d x_d = normalised(*this, px);
  const double max = max_angle();
  const auto solve = [&](const Vector2d& start) {
    return solve_distortion(
        x_d, start, [&](const auto& x) { return distort(distortion, x); },
        [&](const auto& x) { return distortion_jacobian(distortion, x); },
        [&](const auto& x) { return std::atan(x.norm()) <= max; });
  };
  auto x = solve(x_d);
  if (!x) x = solve(without_radial(distortion, x_d, max));
  if (!x) return std::nullopt;
  return Eigen::Vector3d(x->x(), x->y(), 1);
}

PixelJacobian RationalModel::jacobian(const Eigen::Vector3d& ray) const {
  const Vector2d x(ray.x() / ray.z(), ray.y() / ray.z());
  return Vector2d(fx, fy).asDiagonal() * distortion_jacobian(distortion, x) * perspective_jacobian(ray);
}

// The first angle that is not regular, found on a grid of a third of a degree.
double RationalModel::max_angle() const {
  constexpr int kSteps = 270;
  double good = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double angle = kRightAngle * i / kSteps;
    if (!is_regular(distortion, angle))
      return last_that_holds(good, angle, [&](double a) { return is_regular(distortion, a); });
    good = angle;
  }
  return good;
}

}  // namespace edgevo
