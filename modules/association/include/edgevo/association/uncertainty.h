#pragma once
// Point-to-edge uncertainty (paper, section IV-A), as numbers for one point and one edge.
//
// The point projects to p; its match lies on an edge with unit gradient g (the normal) and direction g_perp;
// l is the epipolar direction in the image, theta the angle between g and l (the paper's text swaps these
// names).
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// How far and in which direction the projection moves with the point's depth.
struct DepthMotion {
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< unit l; arbitrary where sigma_mu is 0
  double sigma_mu_px = 0;  ///< max |p(d +- sigma_d) - p(d)|, Eq. (secondcomponent)
};
/// Of the point with the viewing `ray` (x, y, 1), `idepth` > 0 and its standard deviation in the host camera,
/// projected into the target (pixels of `camera`).
DepthMotion depth_motion(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector3d& ray, double idepth,
                         double idepth_sigma);

/// Sigma_p = J Sigma_xi J^T (2x2, px^2): how far the projection moves with the pose, Eq. (poseuncertainty) with the inverse that
/// its print lacks already inside Sigma_xi.
Eigen::Matrix2d projection_covariance(const Pinhole& camera, const Eigen::Vector3d& Y, double idepth,
                                      const Matrix6d& pose_covariance);

/// sigma of a 2-D covariance along a unit direction: sqrt(a^T Sigma a). Exact, and cheaper than the bound by eigenvectors of
/// Eqs. (firstcomponent) and (depthlength), which also lacks absolute values.
double sigma_along(const Eigen::Matrix2d& covariance, const Eigen::Vector2d& direction);

/// sigma_lambda^2 = sigma_(p_|_g)^2 + sigma_mu^2 sin^2(theta), Eq. (rediusuncertainty).
double search_variance(const Eigen::Matrix2d& Sigma_p, const DepthMotion& depth, const Eigen::Vector2d& g);

/// lambda_1/2 = k_p sigma_(p_|_g) + k_mu sigma_mu |sin theta|, Eq. (searchregion), pixels.
double search_half_length(const Eigen::Matrix2d& Sigma_p, const DepthMotion& depth, const Eigen::Vector2d& g, double k_p,
                          double k_mu);

/// C_d = |cos theta| / sigma_(p||g), Eq. (depthconfidence), 1/px; `floor_px` bounds sigma from below.
double depth_confidence(const Eigen::Matrix2d& Sigma_p, const Eigen::Vector2d& l, const Eigen::Vector2d& g,
                        double floor_px);

/// AML after Hu and Mordohai: C_m = 1 / sum exp(-(c - c*)^2 / (2 sigma_c^2)), in (0, 1], 1 = unambiguous. The paper's Eq.
/// (amlconfidence) as printed grows with ambiguity, against its own text. `costs` holds c* itself.
double aml_confidence(const double* costs, int count, double best, double sigma_c);

}  // namespace edgevo
