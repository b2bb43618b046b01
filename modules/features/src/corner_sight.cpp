// SPDX-License-Identifier: BSD-3-Clause
#include "corner_sight.h"

#include <algorithm>
#include <cmath>

namespace edgevo {

CornerSight predict_corner(const CornerInImage& c, const SE3& T, const Pinhole& pinhole) {
  CornerSight s;
  const Eigen::Vector3d far = T.rotation() * c.ray;
  const Eigen::Vector3d& t = T.translation();
  const double noise = kCornerNoisePx * kCornerNoisePx, variance = c.variance;
  Eigen::Vector3d X = far + c.idepth * t;
  if (!(X.z() > kLeastCornerDepth)) return s;
  const auto slope_at = [&] {
    return Eigen::Vector2d(pinhole.fx * (t.x() - X.x() / X.z() * t.z()) / X.z(),
                           pinhole.fy * (t.y() - X.y() / X.z() * t.z()) / X.z());
  };
  const Eigen::Vector2d slope = slope_at(), off = c.px - pinhole.project(X);
  const double change = variance * slope.dot(off) / (noise + variance * slope.squaredNorm());
  const double most = kMaxCornerError * std::sqrt(variance);
  s.idepth = std::max(0.0, c.idepth + std::clamp(change, -most, most));
  X = far + s.idepth * t;
  if (!(X.z() > kLeastCornerDepth)) return s;
  s.is_visible = true;
  s.slope = slope_at();
  s.px = pinhole.project(X) + (c.idepth - s.idepth) * s.slope;
  const double x = X.x() / X.z(), y = X.y() / X.z(), fx = pinhole.fx / X.z(), fy = pinhole.fy / X.z();
  Eigen::Matrix<double, 2, 3> P;
  P << fx, 0, -fx * x, 0, fy, -fy * y;
  s.J.leftCols<3>() = s.idepth * P;
  s.J.rightCols<3>() = -P * skew(X);
  // (noise I + variance g g^T)^-1
  s.weight = (Eigen::Matrix2d::Identity() -
              variance / (noise + variance * s.slope.squaredNorm()) * s.slope * s.slope.transpose()) /
             noise;
  return s;
}

}  // namespace edgevo
