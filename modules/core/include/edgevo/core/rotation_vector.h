// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rotations by their vector: axis times angle, radians.
#include <Eigen/Geometry>
#include <cmath>

namespace edgevo {

/// Rotation about `w` by its length, radians.
inline Eigen::Quaterniond rotation_of(const Eigen::Vector3d& w) {
  const double half = 0.5 * w.norm();
  const double sine = half > 1e-6 ? std::sin(half) / (2 * half) : 0.5 - half * half / 12;
  return {std::cos(half), sine * w.x(), sine * w.y(), sine * w.z()};
}

/// Vector of a rotation, at most pi long: the inverse of rotation_of().
inline Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& q) {
  const double sine = q.vec().norm(), sign = q.w() < 0 ? -1 : 1;
  if (sine < 1e-9) return 2 * sign * q.vec();
  return 2 * sign * std::atan2(sine, sign * q.w()) / sine * q.vec();
}

}  // namespace edgevo
