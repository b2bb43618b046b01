// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Pose of the target from matches, jointly with the noisy depths: the paper's local bundle adjustment on two
// views.
//
// Two views leave the scale free; here the noisy inverse depths, which are metric, constrain it by a prior.
// The bundle adjuster has no priors on depths and needs none: a camera one metre to the side of the host,
// without rotation, sees a point at fx (x + rho) + cx, linear in rho. An observation in that camera at the
// projection of the noisy depth, weighted by 1 / (fx sigma), IS the Gaussian prior.
#include <vector>

#include "edgevo/association/associate.h"
#include "edgevo/study/study_points.h"

namespace edgevo {

/// Result of the adjustment.
struct TwoViewSolution {
  /// False: fewer than 12 matches, or the result is not finite.
  bool usable = false;
  /// Motion from host to target, metres.
  SE3 T_target_host;
  /// Inverse depth of each point; unchanged for points without a match.
  std::vector<double> idepth;
  /// Residual of each point's match along the normal of its edge, pixels; 0 without a match.
  std::vector<double> residual_normal_px;
  /// Residual of each point's match along the tangent of its edge, pixels; 0 without a match.
  std::vector<double> residual_tangent_px;
};

/// `matches` has one entry for each point (kNone if there is no match). A point matched as kEdgeFixed keeps
/// its depth. Starts from `T_start` and the points' noisy depths. Cost: about 2 ms for 800 points.
TwoViewSolution solve_two_view(const Pinhole& pinhole, const std::vector<StudyPoint>& points,
                               const std::vector<Match>& matches, const SE3& T_start);

}  // namespace edgevo
