#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of tracking one frame. Pixels are those of the level that is aligned.
struct AlignmentParams {
  // Coarse start by normalised patches.
  int patch_finest_level = 1;  ///< the coarse start by patches ends on this pyramid level
  int patch_iterations = 12;   ///< at most, each level
  double patch_huber = 0.5;    ///< on the rms of a patch difference, in deviations of the patch
  // Edge alignment, Eq. (edgeerror).
  int edge_iterations = 15;             ///< at most, each level
  double huber_px = 1.0;                ///< width of the robust weight on edge residuals
  double truncation_normal_px = 4.5;    ///< matches beyond this along the edge normal are misses
  double truncation_tangent_px = 6.75;  ///< matches beyond this along the edge are misses
  double min_normal_cosine = 0.7;       ///< orientation gate, signed
  std::string robust = "huber";         ///< weight of edge residuals: "huber" or "student_t"
  // The paper's optional image-gradient cost, Eq. (photometricerror), on the finest level.
  bool photometric = false;         ///< add it (slower)
  double photometric_weight = 0.5;  ///< relative to an edge residual of one pixel
  // Verdict.
  double degraded_share = 0.4;  ///< of the weighed points (pose_evidence.h)
  double lost_share = 0.15;     ///< likewise; below it the frame is LOST
  int min_visible = 60;         ///< points in view; with fewer the frame is lost
  double weak_sigma =
      0.01;  ///< a direction is poorly observed beyond this (share of the median depth, radians)
  // Heuristics.
  /// Edge alignment starts from the predicted pose where that fits the edges better than the patches' pose.
  bool verify_patch_start = true;
  /// A pose far from the median motion of the last frames needs more support (odometry/src/steady_motion.h).
  bool use_median_motion_prior = true;

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

}  // namespace edgevo
