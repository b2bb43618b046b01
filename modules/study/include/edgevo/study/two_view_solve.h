#pragma once
// Pose of the target from matches, with the noisy depths estimated along: the paper's local bundle adjustment
// on two views.
//
// Two views leave the scale free; here the noisy inverse depths, which are metric, hold it by a prior. The
// bundle adjuster knows no priors on depths, and needs none: a camera one metre beside the host, without
// rotation, sees a point at fx (x + rho) + cx, linear in rho. An observation there, at the noisy depth's
// place, weighed by 1 / (fx sigma), IS the Gaussian prior.
#include <vector>

#include "edgevo/association/associate.h"
#include "edgevo/study/study_points.h"

namespace edgevo {

/// What the adjustment found.
struct TwoViewSolution {
  bool usable = false;                      ///< false: fewer than 12 matches, or nothing finite came out
  SE3 T_target_host;                        ///< metres
  std::vector<double> idepth;               ///< of each point; of those without a match as it was
  std::vector<double> residual_normal_px;   ///< of each point's match, along its edge's normal; 0 without
  std::vector<double> residual_tangent_px;  ///< the same along the edge
};

/// `matches` has one entry a point (kNone where there is no match). A point matched as kEdgeFixed keeps its
/// depth. Starts at `T_start` and the points' noisy depths. Cost: about 2 ms for 800 points.
TwoViewSolution solve_two_view(const Pinhole& pinhole, const std::vector<StudyPoint>& points,
                               const std::vector<Match>& matches, const SE3& T_start);

}  // namespace edgevo
