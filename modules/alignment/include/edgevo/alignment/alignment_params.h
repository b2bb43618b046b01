#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

struct AlignmentParams {
  // Coarse start by normalised patches.
  int patch_finest_level = 1;
  int patch_iterations = 12;       ///< at most, each level
  double patch_huber = 0.5;        ///< on the rms of a patch difference, in deviations of the patch
  // Edge alignment, Eq. (edgeerror).
  int edge_iterations = 15;        ///< at most, each level
  double huber_px = 1.0;
  double truncation_normal_px = 4.5;
  double truncation_tangent_px = 6.75;
  double min_normal_cosine = 0.7;  ///< orientation gate, signed
  std::string robust = "huber";
  // The paper's optional image-gradient cost, Eq. (photometricerror), on the finest level.
  bool photometric = false;
  double photometric_weight = 0.5; ///< relative to an edge residual of one pixel
  // Verdict.
  double degraded_share = 0.4;     ///< of the weighed points (pose_evidence.h)
  double lost_share = 0.15;
  int min_visible = 60;            ///< points in view; with fewer the frame is lost
  double weak_sigma = 0.01;        ///< a direction is poorly observed beyond this (share of the median depth, radians)

  void visit(ParamVisitor& v);
};

}  // namespace edgevo
