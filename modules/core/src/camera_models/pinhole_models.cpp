// SPDX-License-Identifier: BSD-3-Clause
// Pinhole, and pinhole with plumb-bob distortion.
#include "lens_math.h"
#include "plumb_bob.h"

namespace edgevo {

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
  const auto x = undistort(distortion, normalised(*this, px));
  if (!x) return std::nullopt;
  return Eigen::Vector3d(x->x(), x->y(), 1);
}

PixelJacobian PlumbBobModel::jacobian(const Eigen::Vector3d& ray) const {
  const Eigen::Vector2d x(ray.x() / ray.z(), ray.y() / ray.z());
  return Eigen::Vector2d(fx, fy).asDiagonal() * distortion_jacobian(distortion, x) *
         perspective_jacobian(ray);
}

double PlumbBobModel::max_angle() const { return range_angle(distortion); }

}  // namespace edgevo
