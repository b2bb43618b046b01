// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// SE(3) alignment of a reference cloud to a frame, coarse to fine.
//
//   1. align_patches: normalised patches on the coarse levels, a wide basin and no need of edges there
//      (coarse Canny edges in foliage do not repeat).
//   2. align_edges: point-to-tangent on the fine levels, paper Eq. (edgeerror): r = g(n)^T (p' - n(p')),
//      where n(p') is the nearest edge pixel and g its unit gradient. Steps are accepted on the truncated
//      cost, in which a point without a match costs the truncation value: else losing points would look like
//      progress.
#include <vector>

#include "edgevo/alignment/alignment_params.h"
#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Outcome of an edge alignment.
struct AlignmentStats {
  /// Points that project into the image.
  int visible = 0;
  /// Visible points with a match within the gates.
  int inliers = 0;
  /// RMS residual of the inliers along the edge normal, pixels.
  double residual_px = 0;
  /// Truncated robust cost per visible point; lower is better.
  double cost = 0;
  /// Sum of w J^T J at the solution, px^-2.
  Matrix6d information = Matrix6d::Zero();
  /// Steps accepted or rejected on this level.
  int iterations = 0;
};

/// Prior on the camera position: the translation v of xi in T_cur_ref = exp(xi) T_expected is zero within
/// `sigma`.
struct TranslationPrior {
  /// Predicted pose, reference to current camera.
  SE3 T_expected;
  /// Standard deviation of v along each camera axis, unit of the map; > 0.
  Eigen::Vector3d sigma;
};

/// Prior on the rotation, such as that of a gyro: w of R_cur_ref = exp(w) R_expected is zero within its
/// covariance, or far off now and then.
struct RotationPrior {
  /// Predicted rotation, reference to current camera.
  Eigen::Quaterniond R_expected = Eigen::Quaterniond::Identity();
  /// Inverse of the covariance of w, rad^-2.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();

  /// Rotation beyond the expected one: w.
  Eigen::Vector3d beyond(const SE3& T_cur_ref) const;
  /// Its weight in the equations of an alignment, px^2 rad^-2, at a pose.
  Eigen::Matrix3d weight(const SE3& T_cur_ref) const;
  /// Its covariance as a measurement at a pose, rad^2: larger where it is far off.
  Eigen::Matrix3d covariance(const SE3& T_cur_ref) const;
  /// Whether a rotation that was measured without it, with the covariance of w, is far off.
  bool is_far_off(const Eigen::Quaterniond& R_cur_ref, const Eigen::Matrix3d& covariance) const;
  /// Its cost at a pose, px^2.
  double cost(const SE3& T_cur_ref) const;
};

/// Improves T_cur_ref on pyramid levels [finest, coarsest], coarsest first. Returns the final robust cost per
/// usable patch (mean square of normalised differences; above 1: no overlap).
double align_patches(const FramePyramid& current, const ReferenceCloud& cloud, int coarsest, int finest,
                     SE3* T_cur_ref);

/// Improves T_cur_ref on one level by Eq. (edgeerror), plus Eq. (photometricerror) on level 0 if
/// params.photometric is set. The result includes the costs and information of `prior` and `turn`, where
/// there are any.
AlignmentStats align_edges(const FramePyramid& current, const ReferenceCloud& cloud, int level,
                           const AlignmentParams& params, SE3* T_cur_ref,
                           const TranslationPrior* prior = nullptr, const RotationPrior* turn = nullptr);

/// The objective of align_edges at one pose: truncated robust cost per point.
double edge_cost(const FramePyramid& current, const ReferenceCloud& cloud, int level,
                 const AlignmentParams& params, const SE3& T_cur_ref);

/// Residual g^T (p' - n) of one point and a given match, with its derivative.
struct EdgeResidual {
  /// Residual, pixels.
  double value = 0;
  /// Derivative of the residual by xi in T_cur_ref <- exp(xi) T_cur_ref, tangent [v, w].
  Eigen::Matrix<double, 1, 6> jacobian;
};
/// Eq. (edgeerror): `ray` (x, y, 1) and `idepth` in the reference camera; `match` in pixels of the current
/// image, with the unit `normal` of its edge. The point must lie in front of the current camera (not
/// checked).
EdgeResidual edge_residual(const Pinhole& camera, const SE3& T_cur_ref, const Eigen::Vector3d& ray,
                           double idepth, const Eigen::Vector2d& match, const Eigen::Vector2d& normal);

}  // namespace edgevo
