#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of tracking one frame. Pixels are those of the level that is aligned.
struct AlignmentParams {
  // Edge alignment, Eq. (edgeerror).
  /// px
  double huber_px = 1.0;
  /// px
  double truncation_normal_px = 4.5;
  /// px
  double truncation_tangent_px = 6.75;
  // Eq. (photometricerror).
  /// on or off
  bool photometric = false;
  // Verdict.
  /// share of the weighed points (pose_evidence.h)
  double degraded_share = 0.4;
  /// share of the weighed points
  double lost_share = 0.15;
  /// points
  int min_visible = 60;
  /// share of the median depth, radians
  double weak_sigma = 0.01;
  // Heuristics.
  /// Edge alignment starts from the predicted pose where that fits the edges better than the patches' pose.
  bool verify_patch_start = true;
  /// A pose far from the median motion of the last frames needs more support (odometry/src/steady_motion.h).
  bool use_median_motion_prior = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
