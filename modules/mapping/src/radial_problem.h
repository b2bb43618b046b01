#pragma once
// A bundle adjustment whose images carry an unknown residual radial distortion (core/radial.h), and the search for its k1.
#include <Eigen/Core>
#include <vector>

#include "bundle_adjustment_profile.h"

namespace edgevo::ba {

/// A BaProblem as the camera FILE sees it: `file.observations[i].px` and `.normal` and `px_host` are in the images that the file's
/// model yields; `file.points[i].ray` is not used.
struct RadialProblem {
  BaProblem file;
  std::vector<Eigen::Vector2d> px_host;  ///< per point
};

/// The same problem for a true pinhole, if the residual coefficient is k1. A match keeps its residual to first order: with
/// D = d px_file / d px, n^T (p_file - m_file) = (D^T n)^T (p - m); the length of D^T n goes into the sigmas.
BaProblem without_radial(const RadialProblem& problem, double k1);

/// How that problem changes with k1.
GlobalDerivative k1_derivative(const RadialProblem& problem, double k1);

struct RadialEstimate {
  bool usable = false;
  double k1 = 0;
  double sigma = 0;      ///< one standard deviation, cluster-robust; see ProfileStep::score_square
  double cost = 0;       ///< at `k1`
  BaProblem solution;    ///< poses and depths at `k1`
};

/// Newton's method on the profile cost, prior k1 ~ N(0, prior_sigma^2), |k1| <= limit. Cost: about three to five solves.
RadialEstimate estimate_k1(const RadialProblem& problem, double start, double prior_sigma, double limit, const BaOptions& options);

}  // namespace edgevo::ba
