// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the data association of one point with one keyframe (paper, section IV).
struct AssociationParams {
  // Search length, Eq. (searchregion).
  /// Factor.
  double k_p = 1.0;
  /// Factor.
  double k_mu = 1.0;
  /// Pixels.
  double min_search_px = 2.0;
  /// Pixels.
  double max_search_px = 12.0;
  // Template matching.
  /// Searches along edges by patches.
  bool photometric = true;
  /// Pixels, odd; S_p.
  int patch_side = 5;
  /// Pixels, odd; tau_S.
  int max_patch_side = 9;
  /// Mean |a - b| of patches divided by their own mean.
  double max_cost = 0.35;
  /// Patch cost.
  double sigma_c = 0.08;
  /// Confidence, 0 to 1.
  double tau_m = 0.3;
  /// Confidence C_d, 1/px.
  double min_depth_confidence = 0.3;
  // Refinement along the normal.
  /// Refines matches along the normal.
  bool refine = true;
  // Match update during the adjustment, Eq. (distancecheck).
  /// Share of the search length.
  double k_m = 0.75;
  // Weight of a match in the adjustment.
  /// Pixels.
  double sigma_normal_px = 0.5;
  /// Pixels.
  double sigma_refined_px = 0.3;
  /// Pixels; 0: point-to-tangent only.
  double sigma_tangent_px = 1.0;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
