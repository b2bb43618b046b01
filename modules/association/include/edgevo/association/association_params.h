#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the data association of one point with one keyframe (paper, section IV).
struct AssociationParams {
  // Search length, Eq. (searchregion).
  double k_p = 1.0, k_mu = 1.0;  ///< gains of pose and depth uncertainty
  double min_search_px = 2.0;      ///< floor: the pose covariance is optimistic
  double max_search_px = 12.0;     ///< cap
  // Template matching.
  bool photometric = true;         ///< search along the edge at all; off: edge matches only
  int patch_side = 5;              ///< S_p, odd
  int max_patch_side = 9;          ///< tau_S, odd
  double max_cost = 0.35;          ///< mean |a - b| of patches divided by their own mean
  double sigma_c = 0.08;           ///< AML's cost deviation
  double tau_m = 0.3;              ///< match confidence below this is ambiguous
  double tau_lambda_px = 0.0;      ///< searches up to this length skip the confidence check
  double min_depth_confidence = 0.3;  ///< C_d below this fixes an ambiguous point's depth, 1/px
  double sigma_p_floor_px = 0.5;   ///< floor of sigma_(p||g) in C_d
  // Gates of the edge match.
  double max_normal_px = 4.0;      ///< projected point to tangent
  double min_normal_cosine = 0.7;  ///< orientation gate between the two edge normals, signed
  // One-dimensional refinement along the normal.
  bool refine = true;  ///< refine matches along the normal at all
  int refine_radius = 4;           ///< patch of 2 r + 1 pixels a side
  int refine_iterations = 12;  ///< at most
  double refine_max_move_px = 3.0;  ///< a refinement that moves further is rejected
  double refine_max_zncc_loss = 0.15;  ///< 1 - ZNCC above which a refinement is rejected
  // Match update during BA, Eq. (distancecheck).
  /// matches further along the edge than this share of the search length are searched again
  double k_m = 0.75;
  // What a match is worth in the BA.
  double sigma_normal_px = 0.5;    ///< edge match
  double sigma_refined_px = 0.3;   ///< edge match refined along its normal
  double sigma_tangent_px = 1.0;   ///< photometric match along the edge; 0: point-to-tangent only

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

}  // namespace edgevo
