// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of tracking one frame. Pixels are those of the aligned pyramid level.
struct AlignmentParams {
  // Edge alignment, Eq. (edgeerror).
  /// Pixels.
  double huber_px = 1.0;
  /// Pixels.
  double truncation_normal_px = 4.5;
  /// Pixels.
  double truncation_tangent_px = 6.75;
  // Eq. (photometricerror).
  /// Adds the photometric cost.
  bool photometric = false;
  // Heuristics.
  /// Edge alignment starts from the predicted pose if that fits the edges better than the pose of the
  /// patches.
  bool verify_patch_start = true;
  /// A pose far from the median motion of the last frames needs more support
  /// (tracking/median_motion_prior.h).
  bool use_median_motion_prior = true;

  /// Names, ranges and texts of the fields of the costs (core/params.h).
  void visit_costs(ParamVisitor& v);
  /// Names, ranges and texts of the fields of the heuristics. In the group `alignment` the thresholds of the
  /// status (confidence/status_params.h) lie between the two.
  void visit_heuristics(ParamVisitor& v);
};

}  // namespace edgevo
