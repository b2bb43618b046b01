// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Point-to-edge uncertainty (paper, section IV-A) of one point and one edge.
//
// The point projects to p; its match lies on an edge with unit gradient g (the normal) and direction g_perp;
// l is the epipolar direction in the image, theta the angle between g and l (the paper's text swaps these
// names).
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Motion of the projection due to the depth of the point.
struct DepthMotion {
  /// Unit epipolar direction l; arbitrary if sigma_mu_px is 0.
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  /// Standard deviation along it, max |p(d +- sigma_d) - p(d)|, Eq. (secondcomponent), pixels.
  double sigma_mu_px = 0;
};
/// Depth motion in the target (pixels of `camera`) of the point with the viewing `ray` (x, y, 1), `idepth` >
/// 0 and its standard deviation in the host camera.
DepthMotion depth_motion(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector3d& ray,
                         double idepth, double idepth_sigma);

/// Covariance of the projection due to the pose, Sigma_p = J Sigma_xi J^T (2x2, px^2), Eq. (poseuncertainty);
/// the inverse that is missing in print is already part of Sigma_xi.
Eigen::Matrix2d projection_covariance(const Pinhole& camera, const Eigen::Vector3d& Y, double idepth,
                                      const Matrix6d& pose_covariance);

/// Standard deviation of a 2-D covariance along a unit direction, sqrt(a^T Sigma a). Exact, and cheaper than
/// the eigenvector bound of Eqs. (firstcomponent) and (depthlength), which also lacks absolute values.
double sigma_along(const Eigen::Matrix2d& covariance, const Eigen::Vector2d& direction);

/// Search variance sigma_lambda^2 = sigma_(p_|_g)^2 + sigma_mu^2 sin^2(theta), Eq. (rediusuncertainty), px^2.
double search_variance(const Eigen::Matrix2d& Sigma_p, const DepthMotion& depth, const Eigen::Vector2d& g);

/// Half search length lambda_1/2 = k_p sigma_(p_|_g) + k_mu sigma_mu |sin theta|, Eq. (searchregion), pixels.
double search_half_length(const Eigen::Matrix2d& Sigma_p, const DepthMotion& depth, const Eigen::Vector2d& g,
                          double k_p, double k_mu);

/// Depth confidence C_d = |cos theta| / sigma_(p||g), Eq. (depthconfidence), 1/px; `floor_px` bounds sigma
/// from below.
double depth_confidence(const Eigen::Matrix2d& Sigma_p, const Eigen::Vector2d& l, const Eigen::Vector2d& g,
                        double floor_px);

/// Match confidence (AML, Hu and Mordohai) C_m = 1 / sum exp(-(c - c*)^2 / (2 sigma_c^2)), in (0, 1], 1 for
/// an unambiguous match. As printed, the paper's Eq. (amlconfidence) grows with ambiguity, contrary to its
/// text. `costs` includes c* = `best`.
double aml_confidence(const double* costs, int count, double best, double sigma_c);

}  // namespace edgevo
