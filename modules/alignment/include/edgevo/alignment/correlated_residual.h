// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Errors of an image that neighbouring edges share: a rolling shutter, the lens, blur. pose_covariance()
// takes edges for independent, so that such errors average out in it; in the pose they do not.
//
// Random effects (Laird and Ware, Biometrics 38, 1982): the residuals of a frame are r = J xi + B theta +
// errors of single edges, where B theta is an affine motion of the image seen across the edge, n^T (theta_1 +
// theta_2 x + theta_3 y, theta_4 + theta_5 x + theta_6 y), with x, y in half widths of the image from its
// middle: as many numbers as a pose has, and what a rolling shutter or a wrong lens makes to first order.
// Each theta has the variance tau^2. The pose absorbs the part A^-1 J^T W B theta, which no residual shows:
//
//   Sigma = tau^2 X X^T,   X = A^-1 J^T W B,   A = J^T W J.
//
// The part that no pose absorbs shows tau. With B' = B - J X, fitting B' lowers the weighted squares by
// S^T T^-1 S, S = B'^T W r, T = B'^T W B'. Its expectation is tau^2 tr T plus what independent edges e make,
// tr(T^-1 sum_e s_e s_e^T), where s_e is the part of S from edge e. Hence tau^2 by the method of moments,
// from one frame or from the sums of several.
#include <vector>

#include "edgevo/alignment/pose_covariance.h"

namespace edgevo {

/// What the residuals of a frame, or of several, show of a smooth error.
struct CorrelatedResidual {
  /// Weighted squares, px^2, that an affine motion explains, less what independent edges let expect. Negative
  /// by chance.
  double explained_px2 = 0;
  /// What `explained_px2` is for each px^2 of variance, tr T.
  double per_px2 = 0;
  /// Covariance of the pose for each px^2 of variance: X X^T, for xi as in pose_covariance.h.
  Matrix6d covariance = Matrix6d::Zero();

  /// Variance tau^2 of the coefficients, px^2, >= 0; 0 where nothing can show it.
  double variance_px2() const { return explained_px2 > 0 && per_px2 > 0 ? explained_px2 / per_px2 : 0; }
};

/// The smooth error of one frame, from its equations at the pose that was found. Cost: 0.05 ms for 1000
/// equations.
CorrelatedResidual correlated_residual(const std::vector<PoseEquation>& equations);

}  // namespace edgevo
