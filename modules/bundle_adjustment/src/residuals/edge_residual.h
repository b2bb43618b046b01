// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The residual of one edge match, Eq. (reprojectionerror), in plain form; bundle_adjustment.h states it with
// its derivatives. The hot loop of edgevo's own solver (normal_equations.cpp) computes the same from packed
// observations and is tested against this form, which Ceres and the profile use directly.
#include <Eigen/Core>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// Residual and Jacobians of one observation.
struct EdgeLinearization {
  /// False if the point is behind the camera; everything else is then 0.
  bool valid = false;
  /// Whitened residual (r_n, r_t); r_t = 0 if inv_sigma_tangent = 0.
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 6> J_target = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Matrix<double, 2, 6> J_host = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Vector2d J_idepth = Eigen::Vector2d::Zero();
};
/// Rotation and translation from the host of a point to a target.
struct TargetFromHost {
  TargetFromHost(const SE3& T_target_world, const SE3& T_host_world);
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
};
EdgeLinearization linearize(const Pinhole& pinhole, const TargetFromHost& T, const BaPoint& point,
                            const BaObservation& observation);
inline EdgeLinearization linearize(const Pinhole& pinhole, const SE3& T_target_world, const SE3& T_host_world,
                                   const BaPoint& point, const BaObservation& observation) {
  return linearize(pinhole, TargetFromHost(T_target_world, T_host_world), point, observation);
}

}  // namespace edgevo::ba
