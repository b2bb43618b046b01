#pragma once
// Edge-guided data association (paper, section IV-B) of one point with one keyframe:
//   nearest edge -> search length -> walk along the edge comparing patches -> match confidence (AML), growing the patch where it is
//   ambiguous -> what stays ambiguous falls back to the edge match, with a depth confidence -> optional 1-D refinement along the normal.
#include <Eigen/Core>

#include "edgevo/association/association_params.h"
#include "edgevo/association/patch_comparison.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// What a match fixes of a point's projection.
enum class MatchKind {
  kNone,         ///< no edge within the gates
  kPhotometric,  ///< best template match along the edge: 2-D residual
  kEdge,         ///< ambiguous along the edge, depth observable: point-to-tangent residual
  kEdgeFixed,    ///< ambiguous and depth hardly observable: point-to-tangent with the depth held fixed
};

/// The point as its host keyframe knows it.
struct AssociationQuery {
  const FramePyramid* host = nullptr;  ///< pyramid of the keyframe that hosts the point; not null
  const FramePyramid* target = nullptr;  ///< pyramid of the keyframe that it is matched in; not null
  Eigen::Vector2d px_host;  ///< position in the host image, finest level, pixels
  Eigen::Vector2d normal_host;  ///< unit gradient there
  double idepth = 0, idepth_sigma = 0;  ///< 1/z in the host camera, > 0, and one standard deviation
  SE3 T_target_host;  ///< predicted pose, host to target
  Matrix6d pose_covariance;      ///< of T_target_host, tangent [v, w]
};

/// Where a point was found in a keyframe, and how far that can be trusted.
struct Match {
  MatchKind kind = MatchKind::kNone;  ///< kNone: all else is meaningless
  Eigen::Vector2d px;            ///< in the target, sub-pixel
  Eigen::Vector2d normal;        ///< unit gradient of the matched edge
  bool refined = false;          ///< along the normal
  double search_px = 0;          ///< lambda_1/2 that was used
  double cost = 0;               ///< of the best patch, kPhotometric only
  double match_confidence = 1;   ///< C_m
  double depth_confidence = 0;   ///< C_d, 1/px
  int patch_side = 0;            ///< at which the search ended
  double inv_sigma_normal = 0, inv_sigma_tangent = 0;  ///< weights for the BA, 1/px
};

/// Cost: about 2 to 6 us.
Match associate(const AssociationQuery& query, const AssociationParams& params);
/// The same with patches compared in another way than by their gradient.
Match associate(const AssociationQuery& query, const AssociationParams& params, const PatchComparison& comparison);

/// Must the match be searched again? |<r, g_perp>| > k_m lambda_max, Eq. (distancecheck) with |e| where the
/// paper prints e, or a residual along the normal beyond 3.5 sigma.
bool needs_update(const Match& match, double residual_normal_px, double residual_tangent_px,
                  const AssociationParams& params);

}  // namespace edgevo
