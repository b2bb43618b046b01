// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/image_motion.h"

#include <algorithm>

namespace edgevo {
namespace {

// Interpolation of `position` in [0, size) between the centres of `cells` cells: the cell before it, and the
// weight of the next one.
struct Between {
  int cell;
  double share;
};
Between between_cells(double position, double size, int cells) {
  const double p = std::clamp((position + 0.5) / size * cells - 0.5, 0.0, double(cells - 1));
  const int cell = p > 0 ? std::min(int(p), cells - 2) : 0;  // 0 if p is NaN
  return {cell, p - cell};
}

}  // namespace

// dX/dt / Z of the point at x.
Eigen::Vector3d ImageMotion::rate(const Pinhole& c, const Eigen::Vector2d& x) const {
  const Between u = between_cells(c.fx * x.x() + c.cx, c.width, kColumns),
                v = between_cells(c.fy * x.y() + c.cy, c.height, kRows);
  const Eigen::RowVector2d across(1 - u.share, u.share);
  const Eigen::Vector2d down(1 - v.share, v.share);
  const double rho = down.dot(idepth.block<2, 2>(v.cell, u.cell) * across.transpose());
  const Eigen::Vector3d ray(x.x(), x.y(), 1.0);
  return rho * velocity.head<3>() + velocity.tail<3>().cross(ray);
}

Eigen::Vector2d ImageMotion::at(const Pinhole& c, const Eigen::Vector2d& x) const {
  const Eigen::Vector3d X = rate(c, x);
  return X.head<2>() - x * X.z();
}

Eigen::Vector2d ImageMotion::acceleration(const Pinhole& c, const Eigen::Vector2d& x) const {
  if (turning.isZero(0)) return Eigen::Vector2d::Zero();
  const Eigen::Vector3d X1 = rate(c, x),
                        X2 = turning.cross(Eigen::Vector3d(x.x(), x.y(), 1.0)) + velocity.tail<3>().cross(X1);
  // Second derivative of X_xy / Z, by Z.
  return X2.head<2>() - 2 * (X1.head<2>() - x * X1.z()) * X1.z() - x * X2.z();
}

}  // namespace edgevo
