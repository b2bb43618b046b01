// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/corrected_pixel.h"

#include <Eigen/LU>

#include "edgevo/edges/image_correction.h"

namespace edgevo {

Eigen::Vector2d correct_pixel(const Pinhole& c, const ImageCorrection& before, const ImageCorrection& now,
                              const ImageMotion& motion, const Eigen::Vector2d& px) {
  const Eigen::Vector2d x = from_file(c, now, motion, to_file(c, before, motion, c.ray(px).head<2>()));
  return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy};
}

// A gradient is a covector: n' ~ (d px / d px')^T n.
Eigen::Vector2d correct_normal(const Pinhole& c, const ImageCorrection& before, const ImageCorrection& now,
                               const ImageMotion& motion, const Eigen::Vector2d& px,
                               const Eigen::Vector2d& normal) {
  const Eigen::Vector2d x = c.ray(px).head<2>();
  const Eigen::Vector2d corrected = from_file(c, now, motion, to_file(c, before, motion, x));
  const Eigen::Matrix2d J =
      file_jacobian(c, before, motion, x).inverse() * file_jacobian(c, now, motion, corrected);
  const Eigen::Vector2d f(c.fx, c.fy);
  return f.cwiseInverse().cwiseProduct(J.transpose() * f.cwiseProduct(normal)).normalized();
}

}  // namespace edgevo
