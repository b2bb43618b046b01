// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Edge-guided data association (paper, section IV-B) of one point with one keyframe:
//   1. the nearest edge and the search length;
//   2. a walk along the edge that compares patches;
//   3. the match confidence (AML), with larger patches where it is ambiguous;
//   4. fallback to an edge match, with a depth confidence, if it remains ambiguous;
//   5. optional one-dimensional refinement along the normal.
#include <Eigen/Core>

#include "edgevo/association/association_params.h"
#include "edgevo/association/patch_comparison.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Which part of a projection a match constrains.
enum class MatchKind {
  /// No edge within the gates.
  kNone,
  /// Best template match along the edge: 2-D residual.
  kPhotometric,
  /// Ambiguous along the edge, depth observable: point-to-tangent residual.
  kEdge,
  /// Ambiguous and depth hardly observable: point-to-tangent residual with fixed depth.
  kEdgeFixed,
};

/// A point of a host keyframe to be matched in a target keyframe.
struct AssociationQuery {
  /// Pyramid of the keyframe that hosts the point; not null.
  const FramePyramid* host = nullptr;
  /// Pyramid of the target keyframe; not null.
  const FramePyramid* target = nullptr;
  /// Position in the host image, finest level, pixels.
  Eigen::Vector2d px_host;
  /// Unit gradient of the host image at the point.
  Eigen::Vector2d normal_host;
  /// Inverse depth 1/z in the host camera, > 0, and its standard deviation.
  double idepth = 0, idepth_sigma = 0;
  /// Predicted pose, host to target.
  SE3 T_target_host;
  /// Covariance of T_target_host, tangent [v, w].
  Matrix6d pose_covariance;
};

/// Position of a point in a keyframe, with confidences and weights.
struct Match {
  /// Kind of the match; with kNone all other fields are meaningless.
  MatchKind kind = MatchKind::kNone;
  /// Sub-pixel position in the target.
  Eigen::Vector2d px;
  /// Unit gradient of the matched edge.
  Eigen::Vector2d normal;
  /// Whether the position was refined along the normal.
  bool refined = false;
  /// Half search length lambda_1/2 that was used, pixels.
  double search_px = 0;
  /// Cost of the best patch, kPhotometric only.
  double cost = 0;
  /// Match confidence C_m, 0 to 1.
  double match_confidence = 1;
  /// Depth confidence C_d, 1/px.
  double depth_confidence = 0;
  /// Patch side at which the search ended, pixels.
  int patch_side = 0;
  /// Weights in the bundle adjustment along the normal and the tangent, 1/px.
  double inv_sigma_normal = 0, inv_sigma_tangent = 0;
};

/// Associates a point by gradient patches. Cost: about 2 to 6 us.
Match associate(const AssociationQuery& query, const AssociationParams& params);
/// Associates a point with another patch comparison.
Match associate(const AssociationQuery& query, const AssociationParams& params,
                const PatchComparison& comparison);

/// Whether the match must be searched again: |<r, g_perp>| > k_m lambda_max, Eq. (distancecheck) with |e|
/// where the paper prints e, or a residual along the normal beyond 3.5 sigma.
bool needs_update(const Match& match, double residual_normal_px, double residual_tangent_px,
                  const AssociationParams& params);

}  // namespace edgevo
