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

/// What an alignment of edges ended with.
struct AlignmentStats {
  int visible = 0;                          ///< points that project into the image
  int inliers = 0;                          ///< of these, matched within the gates
  double residual_px = 0;                   ///< rms of the inliers along the normal
  double cost = 0;                          ///< truncated, a visible point; lower is better
  Matrix6d information = Matrix6d::Zero();  ///< sum of w J^T J at the solution, px^-2
  int iterations = 0;                       ///< steps that were kept or refused, on this level
  /// inliers over visible points, [0, 1]
  double matched_share() const { return visible > 0 ? double(inliers) / visible : 0.0; }
};

/// Where the camera is expected: of xi in T_cur_ref <- exp(xi) T_expected, the translation v has this
/// standard deviation, axis by axis (camera axes, unit of the map; > 0).
struct TranslationPrior {
  SE3 T_expected;         ///< predicted pose, reference to current camera
  Eigen::Vector3d sigma;  ///< one standard deviation, axis by axis
};

/// Improves T_cur_ref on pyramid levels [finest, coarsest], coarsest first. Returns the final robust cost per
/// usable patch (mean square of normalised differences; above 1 means: no overlap).
double align_patches(const FramePyramid& current, const ReferenceCloud& cloud, int coarsest, int finest,
                     SE3* T_cur_ref);

/// Improves T_cur_ref on one level by Eq. (edgeerror), with Eq. (photometricerror) added on level 0 if params
/// ask for it; with a `prior`, its cost and information are in the result's too.
AlignmentStats align_edges(const FramePyramid& current, const ReferenceCloud& cloud, int level,
                           const AlignmentParams& params, SE3* T_cur_ref,
                           const TranslationPrior* prior = nullptr);

/// What align_edges minimises, at one pose: truncated robust cost a point.
double edge_cost(const FramePyramid& current, const ReferenceCloud& cloud, int level,
                 const AlignmentParams& params, const SE3& T_cur_ref);

/// Residual g^T (p' - n) and its derivative for one point and a given match; for tests and for align_edges.
struct EdgeResidual {
  double value = 0;                      ///< pixels
  Eigen::Matrix<double, 1, 6> jacobian;  ///< by xi in T_cur_ref <- exp(xi) T_cur_ref, tangent [v, w]
};
/// Eq. (edgeerror): `ray` (x, y, 1) and `idepth` in the reference camera; `match` in pixels of the current
/// image, with the unit `normal` of its edge. The point must lie in front of the current camera (not
/// checked).
EdgeResidual edge_residual(const Pinhole& camera, const SE3& T_cur_ref, const Eigen::Vector3d& ray,
                           double idepth, const Eigen::Vector2d& match, const Eigen::Vector2d& normal);

}  // namespace edgevo
