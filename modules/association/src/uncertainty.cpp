// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/projection.h"

namespace edgevo {

DepthMotion depth_motion(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector3d& ray,
                         double idepth, double idepth_sigma) {
  DepthMotion motion;
  const Eigen::Matrix3d R = T_target_host.R();
  const Eigen::Vector3d t = T_target_host.translation();
  const Projection at = project(camera, R, t, ray, idepth);
  if (!at.valid) return motion;
  // 1 / unit of the map: practically at infinity, but still in front of the camera.
  constexpr double kMinIdepth = 1e-9;
  for (double sign : {1.0, -1.0}) {
    const Projection moved = project(camera, R, t, ray, std::max(idepth + sign * idepth_sigma, kMinIdepth));
    if (!moved.valid) continue;
    const Eigen::Vector2d step = sign * (moved.px - at.px);
    const double length = step.norm();
    if (length <= motion.sigma_mu_px) continue;
    motion.sigma_mu_px = length;  // Eq. (secondcomponent)
    motion.direction = step / length;
  }
  return motion;
}

Eigen::Matrix2d projection_covariance(const Pinhole& camera, const Eigen::Vector3d& Y, double idepth,
                                      const Matrix6d& pose_covariance) {
  const Eigen::Matrix<double, 2, 6> J = pose_jacobian(camera, Y, idepth);
  return J * pose_covariance * J.transpose();  // Eq. (poseuncertainty)
}

double sigma_along(const Eigen::Matrix2d& covariance, const Eigen::Vector2d& direction) {
  return std::sqrt(std::max(0.0, direction.dot(covariance * direction)));
}

double search_variance(const Eigen::Matrix2d& Sigma_p, const DepthMotion& depth, const Eigen::Vector2d& g) {
  const Eigen::Vector2d g_perp(-g.y(), g.x());
  const double sin_theta = g_perp.dot(depth.direction);
  return g_perp.dot(Sigma_p * g_perp) +
         std::pow(depth.sigma_mu_px * sin_theta, 2);  // Eq. (rediusuncertainty)
}

double search_half_length(const Eigen::Matrix2d& Sigma_p, const DepthMotion& depth, const Eigen::Vector2d& g,
                          double k_p, double k_mu) {
  const Eigen::Vector2d g_perp(-g.y(), g.x());
  return k_p * sigma_along(Sigma_p, g_perp) +
         k_mu * depth.sigma_mu_px * std::abs(g_perp.dot(depth.direction));  // Eq. (searchregion)
}

double depth_confidence(const Eigen::Matrix2d& Sigma_p, const Eigen::Vector2d& l, const Eigen::Vector2d& g,
                        double floor_px) {
  return std::abs(g.dot(l)) / std::max(sigma_along(Sigma_p, g), floor_px);  // Eq. (depthconfidence)
}

double aml_confidence(const double* costs, int count, double best, double sigma_c) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double d = (costs[i] - best) / sigma_c;
    sum += std::exp(-0.5 * d * d);
  }
  return 1.0 / std::max(sum, 1.0);  // Eq. (amlconfidence), corrected
}

}  // namespace edgevo
