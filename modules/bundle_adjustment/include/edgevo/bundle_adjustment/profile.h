#pragma once
// Global unknowns k of a bundle adjustment (a few numbers that all observations share, such as coefficients
// of the camera), found by minimising the profile cost
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

/// Number of global unknowns: k1 and the read-out time (self_calibration). Known to the compiler, so that
/// nothing is allocated.
constexpr int kUnknowns = 2;
/// k, or a gradient by it.
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
/// A curvature or covariance of k.
using UnknownsSquare = Eigen::Matrix<double, kUnknowns, kUnknowns>;
/// d / dk of an image point; a column an unknown.
using ImageRate = Eigen::Matrix<double, 2, kUnknowns>;

/// How rays and matches move with k.
struct GlobalDerivative {
  std::vector<ImageRate> ray;  ///< per point, d (x, y) / dk of its host ray
  std::vector<ImageRate> px;   ///< per observation, dm / dk in pixels
};

/// The profile cost's derivatives at one k, and how the map moves with k.
struct ProfileStep {
  Unknowns gradient = Unknowns::Zero();               ///< C'
  UnknownsSquare curvature = UnknownsSquare::Zero();  ///< C''
  /// sum over hosts of the square of each host's own part of C'. Errors of one image are not independent, so
  /// that C''^-1 score_square C''^-1 is an honest covariance of k (the cluster-robust "sandwich"), C''^-1 is
  /// not.
  UnknownsSquare score_square = UnknownsSquare::Zero();
  /// dpose/dk, left perturbations, 6 rows a pose; 0 for fixed poses.
  Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> pose_rate;
  std::vector<Eigen::Matrix<double, 1, kUnknowns>> idepth_rate;  ///< per point
  bool usable = false;  ///< false: the normal equations have no finite solution
};

/// `problem` must stand at its minimum (BundleAdjuster::solve). Cost: about two linearisations and one 6n x
/// 6n factorisation.
ProfileStep profile_step(const BaProblem& problem, const GlobalDerivative& derivative,
                         const BaOptions& options);

}  // namespace edgevo::ba
