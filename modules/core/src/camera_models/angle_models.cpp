// SPDX-License-Identifier: BSD-3-Clause
// Lenses that are a function from the angle to the axis to the distance from the principal point: Kannala and
// Brandt, FOV.
#include <algorithm>

#include "lens_math.h"

namespace edgevo {
namespace {

using Vector2d = Eigen::Vector2d;
using Vector3d = Eigen::Vector3d;

double angle_of(const Vector3d& ray) { return std::atan2(ray.head<2>().norm(), ray.z()); }

// Normalised coordinates at the distance `r`.
Vector2d at_radius(const Vector3d& ray, double r) {
  const double rho = ray.head<2>().norm();
  return rho > 0 ? Vector2d(ray.head<2>() * (r / rho)) : Vector2d::Zero();
}

Vector3d ray_at_angle(const Vector2d& x, double angle) {
  const double r = x.norm();
  if (!(r > 0)) return Vector3d::UnitZ();
  Vector3d ray;
  ray << x * (std::sin(angle) / r), std::cos(angle);
  return ray;
}

// Of x = (X, Y) r(angle) / rho, rho = |(X, Y)|, given r and its slope.
PixelJacobian radial_jacobian_3d(const Vector3d& ray, double r, double slope) {
  const double rho = ray.head<2>().norm(), square = ray.squaredNorm();
  const double factor = rho > 0 ? r / rho : slope / ray.z();
  PixelJacobian J;
  J.leftCols<2>() = factor * Eigen::Matrix2d::Identity();
  if (rho > 0) {
    const Vector2d direction = ray.head<2>() / rho;
    J.leftCols<2>() += (slope * ray.z() / square - factor) * direction * direction.transpose();
  }
  J.col(2) = -ray.head<2>() * (slope / square);
  return J;
}

double radius(const KannalaBrandtModel& m, double angle) {
  const double t = angle * angle;
  return angle * (1 + t * (m.k1 + t * (m.k2 + t * (m.k3 + t * m.k4))));
}

double slope(const KannalaBrandtModel& m, double angle) {
  const double t = angle * angle;
  return 1 + t * (3 * m.k1 + t * (5 * m.k2 + t * (7 * m.k3 + t * 9 * m.k4)));
}

// Newton's method within a shrinking interval of [0, max_angle], where the radius grows with the angle.
double angle_at(const KannalaBrandtModel& m, double r, double max_angle) {
  constexpr int kMaxSteps = 100;
  double low = 0, high = max_angle, angle = std::min(r, max_angle);
  for (int i = 0; i < kMaxSteps; ++i) {
    const double error = radius(m, angle) - r;
    (error < 0 ? low : high) = angle;
    double next = angle - error / slope(m, angle);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - angle) < 1e-15 * (1 + angle)) return next;
    angle = next;
  }
  return angle;
}

}  // namespace

// ---- Kannala and Brandt ----

std::optional<Vector2d> KannalaBrandtModel::project(const Vector3d& ray) const {
  if (is_backwards(ray)) return std::nullopt;
  return pixel(*this, at_radius(ray, radius(*this, angle_of(ray))));
}

std::optional<Vector3d> KannalaBrandtModel::unproject(const Vector2d& px) const {
  const Vector2d x = normalised(*this, px);
  const double max = max_angle();
  if (!(x.norm() <= radius(*this, max))) return std::nullopt;
  return ray_at_angle(x, angle_at(*this, x.norm(), max));
}

PixelJacobian KannalaBrandtModel::jacobian(const Vector3d& ray) const {
  const double angle = angle_of(ray);
  return Vector2d(fx, fy).asDiagonal() * radial_jacobian_3d(ray, radius(*this, angle), slope(*this, angle));
}

// The first angle at which the slope is too small, found on a grid of less than a degree.
double KannalaBrandtModel::max_angle() const {
  constexpr int kSteps = 200;
  const auto is_steep = [&](double angle) { return slope(*this, angle) >= kMinSlope; };
  double good = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double angle = kHalfTurn * i / kSteps;
    if (!is_steep(angle)) return last_that_holds(good, angle, is_steep);
    good = angle;
  }
  return good;
}

// ---- FOV ----

std::optional<Vector2d> FovModel::project(const Vector3d& ray) const {
  if (is_backwards(ray)) return std::nullopt;
  const double a = 2 * std::tan(omega / 2);
  return pixel(*this, at_radius(ray, std::atan2(a * ray.head<2>().norm(), ray.z()) / a));
}

std::optional<Vector3d> FovModel::unproject(const Vector2d& px) const {
  const Vector2d x = normalised(*this, px);
  const double a = 2 * std::tan(omega / 2), distorted = a * x.norm();
  if (!(distorted <= kHalfTurn)) return std::nullopt;
  const double angle = std::atan2(std::sin(distorted), a * std::cos(distorted));
  if (angle > max_angle()) return std::nullopt;
  return ray_at_angle(x, angle);
}

PixelJacobian FovModel::jacobian(const Vector3d& ray) const {
  const double a = 2 * std::tan(omega / 2), rho = ray.head<2>().norm();
  const double slope = ray.squaredNorm() / (a * a * rho * rho + ray.z() * ray.z());
  return Vector2d(fx, fy).asDiagonal() * radial_jacobian_3d(ray, std::atan2(a * rho, ray.z()) / a, slope);
}

// The axis backwards has no direction in the image.
double FovModel::max_angle() const { return kHalfTurn - 1e-6; }

}  // namespace edgevo
