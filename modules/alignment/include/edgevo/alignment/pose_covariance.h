// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Covariance of an aligned pose: that of xi in T_cur_ref <- exp(xi) T_cur_ref, tangent [v, w], unit of the
// map and radians.
//
// Paper, Eq. (poseuncertainty), with the inverse that is missing in print: Sigma = A^-1 sigma_r^2, A = sum w
// J^T J. That assumes independent residuals. Points on one edge share the error of that edge, so the sum of
// their scores g = w r J^T varies more than their number suggests. The sandwich estimator measures by how
// much, with the edges as clusters:
//
//   Sigma = A^-1 M A^-1,   M = n/(n - 6) sum_e (sum_{p in e} g_p) (sum_{p in e} g_p)^T   over n edges e,
//
// bounded below by A^-1 sigma_r^2 in every direction, so that a direction that no edge constrains does not
// appear certain. Residuals do not show the error of the reference itself, whose cloud was placed by an
// alignment of the same kind. kReferenceShare, one factor for all scenes, accounts for it.
//
// What several edges share is not in it: correlated_residual.h.
//
// It is the covariance of the pose relative to the reference keyframe, in the local unit of length of the
// map. The scale of a monocular map drifts along the path: unit_covariance(), which a reported pose includes.
// tests/regression compares both with ground truth of rendered scenes.
#include <vector>

#include "edgevo/core/se3.h"

namespace edgevo {

/// Contribution of a matched point to the normal equations.
struct PoseEquation {
  /// Derivative of the residual by xi, tangent [v, w].
  Eigen::Matrix<double, 1, 6> jacobian;
  /// Residual along the edge normal, pixels.
  double residual_px = 0;
  /// Robust weight times the weight of the depth, 0 to 1.
  double weight = 0;
  /// Number of the edge that the point is matched with, >= 0.
  int edge = 0;
  /// Unit normal of that edge.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  /// Where the point is seen: half widths of the image from its middle.
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
};

/// Ratio of the variance including the error of the reference to that of the alignment alone: 1.41 to 1.69
/// measured on four rendered scenes. confidence/tracking_check.h detects at run time where a map is worse.
constexpr double kReferenceShare = 1.5;

/// Sandwich covariance of a pose, times kReferenceShare. Without equations the result is 1e9 times
/// kMinResidualVariance. Cost: 0.05 ms for 1500 equations.
Matrix6d pose_covariance(const std::vector<PoseEquation>& equations);

/// Part of the covariance of T_cur_ref that comes from the unit of length, which drifts by 0.2 to 1 % along a
/// path: (0.01 t)(0.01 t)^T for its translation t, nothing for the rotation. Cost: 10 ns.
Matrix6d unit_covariance(const SE3& T_cur_ref);

/// Squared error xi = log(T_estimate T_true^-1), normalised by its covariance. The component along the
/// translation, which a wrong unit of length causes, is projected out with the covariance as metric. Follows
/// chi^2 with kNormalisedErrorFreedom degrees of freedom if the covariance is right.
double normalised_error_square(const SE3& T_estimate, const SE3& T_true, const Matrix6d& covariance);
/// Degrees of freedom of normalised_error_square(): six of a pose, less the length.
constexpr int kNormalisedErrorFreedom = 5;

}  // namespace edgevo
