#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the data association of one point with one keyframe (paper, section IV).
struct AssociationParams {
  // Search length, Eq. (searchregion).
  /// factor
  double k_p = 1.0;
  /// factor
  double k_mu = 1.0;
  /// px
  double min_search_px = 2.0;
  /// px
  double max_search_px = 12.0;
  // Template matching.
  /// on or off
  bool photometric = true;
  /// px, odd; S_p
  int patch_side = 5;
  /// px, odd; tau_S
  int max_patch_side = 9;
  /// mean |a - b| of patches divided by their own mean
  double max_cost = 0.35;
  /// patch cost
  double sigma_c = 0.08;
  /// [0, 1]
  double tau_m = 0.3;
  /// 1/px; of C_d
  double min_depth_confidence = 0.3;
  // Refinement along the normal.
  /// on or off
  bool refine = true;
  // Match update during the adjustment, Eq. (distancecheck).
  /// share of the search length
  double k_m = 0.75;
  // What a match is worth in the adjustment.
  /// px
  double sigma_normal_px = 0.5;
  /// px
  double sigma_refined_px = 0.3;
  /// px; 0: point-to-tangent only
  double sigma_tangent_px = 1.0;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
