// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/corrected_pixel.h"

#include <Eigen/LU>

#include "edgevo/edges/image_correction.h"

namespace edgevo {

Eigen::Vector2d correct_pixel(const Rectification& r, const ImageCorrection& before,
                              const ImageCorrection& now, const ImageMotion& motion,
                              const Eigen::Vector2d& px) {
  const Pinhole& c = r.target();
  const Eigen::Vector2d x = from_file(r, now, motion, to_file(r, before, motion, c.ray(px).head<2>()));
  return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy};
}

// A gradient is a covector: n' ~ (d px / d px')^T n.
Eigen::Vector2d correct_normal(const Rectification& r, const ImageCorrection& before,
                               const ImageCorrection& now, const ImageMotion& motion,
                               const Eigen::Vector2d& px, const Eigen::Vector2d& normal) {
  const Pinhole& c = r.target();
  const Eigen::Vector2d x = c.ray(px).head<2>();
  const Eigen::Vector2d corrected = from_file(r, now, motion, to_file(r, before, motion, x));
  const Eigen::Matrix2d J =
      file_jacobian(r, before, motion, x).inverse() * file_jacobian(r, now, motion, corrected);
  const Eigen::Vector2d f(c.fx, c.fy);
  return f.cwiseInverse().cwiseProduct(J.transpose() * f.cwiseProduct(normal)).normalized();
}

SE3 correct_motion(const SE3& T, double image_ratio) {
  Vector6d motion = T.log();
  motion.segment<2>(0) *= image_ratio, motion.segment<2>(3) *= image_ratio;
  return SE3::exp(motion);
}

}  // namespace edgevo
