// SPDX-License-Identifier: BSD-3-Clause
// Lenses that project onto a sphere first: (X, Y) over a denominator that grows with the distance. Extended
// unified model, double sphere, omnidirectional camera of Mei.
#include <algorithm>

#include "lens_math.h"
#include "plumb_bob.h"

namespace edgevo {
namespace {

using Vector2d = Eigen::Vector2d;
using Vector3d = Eigen::Vector3d;

// Denominator of a projection, and its gradient by the ray.
struct Denominator {
  double value;
  Vector3d gradient;
};

std::optional<Vector2d> divide(const Vector3d& ray, const Denominator& d) {
  if (is_backwards(ray) || !(d.value > 0)) return std::nullopt;
  return Vector2d(ray.head<2>() / d.value);
}

PixelJacobian quotient_jacobian(const Vector3d& ray, const Denominator& d) {
  PixelJacobian J = -ray.head<2>() / (d.value * d.value) * d.gradient.transpose();
  J.leftCols<2>() += Eigen::Matrix2d::Identity() / d.value;
  return J;
}

Denominator denominator(const ExtendedUnifiedModel& m, const Vector3d& p) {
  const double d = std::sqrt(m.beta * p.head<2>().squaredNorm() + p.z() * p.z());
  Vector3d by_ray = m.alpha / d * Vector3d(m.beta * p.x(), m.beta * p.y(), p.z());
  by_ray.z() += 1 - m.alpha;
  return {m.alpha * d + (1 - m.alpha) * p.z(), by_ray};
}

Denominator denominator(const DoubleSphereModel& m, const Vector3d& p) {
  const double d1 = p.norm(), z = m.xi * d1 + p.z();
  const double d2 = std::sqrt(p.head<2>().squaredNorm() + z * z);
  const Vector3d z_by_ray = m.xi / d1 * p + Vector3d::UnitZ();
  const Vector3d d2_by_ray = (Vector3d(p.x(), p.y(), 0) + z * z_by_ray) / d2;
  return {m.alpha * d2 + (1 - m.alpha) * z, m.alpha * d2_by_ray + (1 - m.alpha) * z_by_ray};
}

Denominator denominator(const OmniModel& m, const Vector3d& p) {
  const double d = p.norm();
  return {p.z() + m.xi * d, m.xi / d * p + Vector3d::UnitZ()};
}

// Largest angle of the projection from a sphere, before the distortion.
double sphere_angle(const OmniModel& m) { return std::acos(m.xi <= 1 ? -m.xi : -1 / m.xi); }

// z of the ray (x, y, z) that a camera of the (extended) unified model shows at x, y. Nullopt outside its
// image.
std::optional<double> unified_z(double alpha, double beta, double r2) {
  const double square = 1 - (2 * alpha - 1) * beta * r2;
  if (!(square >= 0)) return std::nullopt;
  const double below = alpha * std::sqrt(square) + 1 - alpha;
  if (!(below > 0)) return std::nullopt;
  return (1 - beta * alpha * alpha * r2) / below;
}

}  // namespace

// ---- extended unified model ----

std::optional<Vector2d> ExtendedUnifiedModel::project(const Vector3d& ray) const {
  const auto x = divide(ray, denominator(*this, ray));
  return x ? std::optional<Vector2d>(pixel(*this, *x)) : std::nullopt;
}

std::optional<Vector3d> ExtendedUnifiedModel::unproject(const Vector2d& px) const {
  const Vector2d x = normalised(*this, px);
  const auto z = unified_z(alpha, beta, x.squaredNorm());
  if (!z) return std::nullopt;
  return Vector3d(x.x(), x.y(), *z);
}

PixelJacobian ExtendedUnifiedModel::jacobian(const Vector3d& ray) const {
  return Vector2d(fx, fy).asDiagonal() * quotient_jacobian(ray, denominator(*this, ray));
}

// Up to alpha 1/2 the denominator vanishes where tan^2 = (1 - 2 alpha) / (alpha^2 beta); beyond, the image
// folds over where z = -w d, w = (1 - alpha) / alpha.
double ExtendedUnifiedModel::max_angle() const {
  if (alpha <= 0) return kRightAngle;
  const double w = (1 - alpha) / alpha;
  const double tan_square =
      alpha <= 0.5 ? (1 - 2 * alpha) / (alpha * alpha * beta) : (1 - w * w) / (w * w * beta);
  return kHalfTurn - std::atan(std::sqrt(std::max(0.0, tan_square)));
}

// ---- double sphere ----

std::optional<Vector2d> DoubleSphereModel::project(const Vector3d& ray) const {
  const auto x = divide(ray, denominator(*this, ray));
  return x ? std::optional<Vector2d>(pixel(*this, (1 + xi) * *x)) : std::nullopt;
}

std::optional<Vector3d> DoubleSphereModel::unproject(const Vector2d& px) const {
  const Vector2d x = normalised(*this, px) / (1 + xi);
  const double r2 = x.squaredNorm();
  const auto z = unified_z(alpha, 1, r2);
  if (!z) return std::nullopt;
  const double square = *z * *z + (1 - xi * xi) * r2;
  if (!(square >= 0)) return std::nullopt;
  const double length = (*z * xi + std::sqrt(square)) / (*z * *z + r2);
  return Vector3d(length * x.x(), length * x.y(), length * *z - xi);
}

PixelJacobian DoubleSphereModel::jacobian(const Vector3d& ray) const {
  return (1 + xi) * Vector2d(fx, fy).asDiagonal() * quotient_jacobian(ray, denominator(*this, ray));
}

// The second sphere's image ends at z2 = -w d2, with z2 = xi + cos and d2^2 = 1 + 2 xi cos + xi^2: a
// quadratic equation for the cosine. Beyond xi 1 the first sphere's ends at cos = -1 / xi.
double DoubleSphereModel::max_angle() const {
  const double w = alpha <= 0.5 ? alpha / (1 - alpha) : (1 - alpha) / alpha;
  const double square = 1 - xi * xi * (1 - w * w);
  double cosine = square >= 0 ? -xi * (1 - w * w) - w * std::sqrt(square) : -1;
  if (xi > 1) cosine = std::max(cosine, -1 / xi);
  return std::acos(std::max(-1.0, cosine));
}

// ---- omnidirectional camera of Mei ----

std::optional<Vector2d> OmniModel::project(const Vector3d& ray) const {
  const auto x = divide(ray, denominator(*this, ray));
  return x ? std::optional<Vector2d>(pixel(*this, (1 + xi) * distort(distortion, *x))) : std::nullopt;
}

std::optional<Vector3d> OmniModel::unproject(const Vector2d& px) const {
  const auto x = undistort(distortion, normalised(*this, px) / (1 + xi));
  if (!x) return std::nullopt;
  const double r2 = x->squaredNorm(), square = 1 + (1 - xi * xi) * r2;
  if (!(square >= 0)) return std::nullopt;
  const double length = (xi + std::sqrt(square)) / (r2 + 1);
  return Vector3d(length * x->x(), length * x->y(), length - xi);
}

PixelJacobian OmniModel::jacobian(const Vector3d& ray) const {
  const Denominator d = denominator(*this, ray);
  return (1 + xi) * Vector2d(fx, fy).asDiagonal() * distortion_jacobian(distortion, ray.head<2>() / d.value) *
         quotient_jacobian(ray, d);
}

double OmniModel::max_angle() const {
  return last_that_holds(0, sphere_angle(*this), [&](double angle) {
    return is_in_range(distortion, std::sin(angle) / (std::cos(angle) + xi));
  });
}

}  // namespace edgevo
