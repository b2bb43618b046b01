// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Global unknowns k of a bundle adjustment (a few numbers shared by all observations, such as camera
// coefficients), estimated by minimising the profile cost
//     C(k) = min over poses and depths of cost(k, poses, depths).
// At the minimum over poses and depths, one linearisation gives C'(k) and C''(k): with r the whitened
// residuals, w their robust weights,
//     dr/dk = J_k + J_pose dpose/dk + J_rho drho/dk     along the path of minima (implicit function theorem)
//     C' = sum w (dr/dk)^T r,   C'' = sum w (dr/dk)^T (dr/dk)        (Gauss-Newton)
// and the rates of the poses and depths predict them for the next k.
#include <Eigen/Core>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// Number of global unknowns: those of a camera (self_calibration). A constant, so that nothing is allocated.
constexpr int kUnknowns = 6;
/// The first of them, those that a run corrects: derivatives by these alone take half the work.
constexpr int kFirstUnknowns = 2;
/// Global unknowns k, or a gradient with respect to them.
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
/// Curvature with respect to k, or covariance of k.
using UnknownsSquare = Eigen::Matrix<double, kUnknowns, kUnknowns>;
/// Derivative of an image point by k, one column per unknown.
using ImageRate = Eigen::Matrix<double, 2, kUnknowns>;

/// Derivatives of rays and matches by k.
struct GlobalDerivative {
  /// Per point, d (x, y) / dk of its host ray.
  std::vector<ImageRate> ray;
  /// Per observation, dm / dk in pixels.
  std::vector<ImageRate> px;
  /// d ln(inv_sigma) / dk, the same for all observations: what changes the size of all images changes the
  /// sigmas in their pixels, too.
  Unknowns log_inv_sigma = Unknowns::Zero();
};

/// Derivatives of the profile cost, and of the map, at one k.
struct ProfileStep {
  /// Gradient C'.
  Unknowns gradient = Unknowns::Zero();
  /// Curvature C''.
  UnknownsSquare curvature = UnknownsSquare::Zero();
  /// Sum over hosts of the square of each host's share of C'. Errors in one image are not independent:
  /// C''^-1 score_square C''^-1 is a valid covariance of k (the cluster-robust "sandwich"), C''^-1 is not.
  UnknownsSquare score_square = UnknownsSquare::Zero();
  /// Derivative dpose/dk, left perturbations, 6 rows per pose; 0 for fixed poses.
  Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> pose_rate;
  /// Derivative drho/dk of each point.
  std::vector<Eigen::Matrix<double, 1, kUnknowns>> idepth_rate;
  /// False if the normal equations have no finite solution.
  bool usable = false;
};

/// Derivatives at the minimum of `problem` over poses and depths (BundleAdjuster::solve), where it must be.
/// `only_first`: by the first kFirstUnknowns alone, with the same numbers; those of the others are zero.
/// Cost: about two linearisations and one 6n x 6n factorisation.
ProfileStep profile_step(const BaProblem& problem, const GlobalDerivative& derivative,
                         const BaOptions& options, bool only_first = false);

}  // namespace edgevo::ba
