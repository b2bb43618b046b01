#pragma once
// A global unknown k of a bundle adjustment (one number that all observations share, such as a coefficient of the camera), found by
// minimising the profile cost
//     C(k) = min over poses and depths of cost(k, poses, depths).
// At the minimum over poses and depths, one linearisation gives C'(k) and C''(k): with r the whitened residuals, w their robust weights,
//     dr/dk = J_k + J_pose dpose/dk + J_rho drho/dk     along the path of minima (implicit function theorem)
//     C' = sum w r dr/dk,   C'' = sum w (dr/dk)^2        (Gauss-Newton)
// and the rates of the poses and depths predict them for the next k.
#include <Eigen/Core>
#include <vector>

#include "edgevo/mapping/bundle_adjustment.h"

namespace edgevo::ba {

/// How rays and matches move with k.
struct GlobalDerivative {
  std::vector<Eigen::Vector2d> ray;  ///< per point, d (x, y) / dk of its host ray
  std::vector<Eigen::Vector2d> px;   ///< per observation, dm / dk in pixels
};

struct ProfileStep {
  double gradient = 0;   ///< C'
  double curvature = 0;  ///< C''
  /// sum over hosts of the square of each host's own part of C'. Errors of one image are not independent, so that
  /// sqrt(score_square) / C'' is an honest standard deviation of k (the cluster-robust "sandwich"), sqrt(1 / C'') is not.
  double score_square = 0;
  Eigen::VectorXd pose_rate;        ///< dpose/dk, left perturbations, 6 rows a pose; 0 for fixed poses
  std::vector<double> idepth_rate;  ///< per point
  bool usable = false;
};

/// `problem` must stand at its minimum (BundleAdjuster::solve). Cost: about two linearisations and one 6n x 6n factorisation.
ProfileStep profile_step(const BaProblem& problem, const GlobalDerivative& derivative, const BaOptions& options);

}  // namespace edgevo::ba
