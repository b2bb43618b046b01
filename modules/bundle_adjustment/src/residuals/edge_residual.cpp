// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/edge_residual.h"

#include "packed_problem.h"

namespace edgevo::ba {
namespace {

// d pi(Y) / d Y, in pixels.
Eigen::Matrix<double, 2, 3> projection_jacobian(const Pinhole& c, const Eigen::Vector3d& Y) {
  const double inv = 1.0 / Y.z();
  Eigen::Matrix<double, 2, 3> J;
  J << c.fx * inv, 0, -c.fx * Y.x() * inv * inv, 0, c.fy * inv, -c.fy * Y.y() * inv * inv;
  return J;
}

// Rows of the edge's own axes over their standard deviations.
Eigen::Matrix2d whitening(const BaObservation& o) {
  Eigen::Matrix2d W;
  W << o.inv_sigma_normal * o.normal.x(), o.inv_sigma_normal * o.normal.y(),  //
      -o.inv_sigma_tangent * o.normal.y(), o.inv_sigma_tangent * o.normal.x();
  return W;
}

// d (rho times the point) for a left perturbation of the frame that the point is in.
Eigen::Matrix<double, 3, 6> point_jacobian(double idepth, const Eigen::Vector3d& scaled_point) {
  Eigen::Matrix<double, 3, 6> J;
  J << idepth * Eigen::Matrix3d::Identity(), -skew(scaled_point);
  return J;
}

}  // namespace

TargetFromHost::TargetFromHost(const SE3& T_target_world, const SE3& T_host_world) {
  const SE3 T = T_target_world * T_host_world.inverse();
  R = T.R();
  t = T.translation();
}

EdgeLinearization linearize(const Pinhole& pinhole, const TargetFromHost& T, const BaPoint& point,
                            const BaObservation& observation) {
  EdgeLinearization lin;
  const Eigen::Matrix3d& R = T.R;
  const Eigen::Vector3d Y = R * point.ray + point.idepth * T.t;
  lin.valid = Y.z() > kMinDepthRatio;
  if (!lin.valid) return lin;
  const Eigen::Matrix2d W = whitening(observation);
  const Eigen::Matrix<double, 2, 3> J_Y = W * projection_jacobian(pinhole, Y);
  lin.residual = W * (pinhole.project(Y) - observation.px);  // Eq. (reprojectionerror), in the edge's axes
  lin.J_target = J_Y * point_jacobian(point.idepth, Y);
  lin.J_host = -J_Y * R * point_jacobian(point.idepth, point.ray);
  lin.J_idepth = J_Y * T.t;
  return lin;
}

}  // namespace edgevo::ba
