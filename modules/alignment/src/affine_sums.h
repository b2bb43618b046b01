// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sums over the equations of a pose with an affine motion of the image next to it: what a smooth error makes
// of the residuals (correlated_residual.h), and an enlargement, which is one of them (image_zoom.h).
#include <Eigen/Cholesky>
#include <vector>

#include "edgevo/alignment/pose_covariance.h"

namespace edgevo {

/// px^-2, added to the information of the pose: it is invertible then.
constexpr double kPoseRidge = 1e-9;
/// Share of the information of all motions: less is what the pose absorbs, or rounding.
constexpr double kAbsorbedShare = 1e-6;

/// Weighted residuals of an edge times their derivatives.
struct AffineScore {
  /// By the pose.
  Vector6d by_pose = Vector6d::Zero();
  /// By the coefficients of the motion.
  Vector6d by_affine = Vector6d::Zero();
};

/// Sums with J, the derivatives of the residuals by the pose, B, those by the coefficients, and weights W.
struct AffineSums {
  /// Of all equations, in pixels.
  explicit AffineSums(const std::vector<PoseEquation>& equations);

  /// J^T W J, J^T W B and B^T W B.
  Matrix6d of_pose = Matrix6d::Zero(), across = Matrix6d::Zero(), of_affine = Matrix6d::Zero();
  /// By number of the edge.
  std::vector<AffineScore> of_edge;

  /// X: what the pose absorbs of each coefficient.
  Matrix6d absorbed() const;
};

}  // namespace edgevo
