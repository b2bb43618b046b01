// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A bundle adjustment whose images are affected by what the camera file does not contain, a residual radial
// distortion and a rolling shutter (edges/image_correction.h), and the search for both.
#include <Eigen/Core>
#include <vector>

#include "edgevo/bundle_adjustment/profile.h"
#include "edgevo/core/run_warnings.h"
#include "edgevo/edges/image_correction.h"

namespace edgevo {

/// A BaProblem as the camera FILE sees it: `file.observations[i].px`, `.normal` and `px_host` are in images
/// undistorted by the file's model; `file.points[i].ray` is not used.
struct CameraProblem {
  /// Poses, depths and matches.
  BaProblem file;
  /// Camera of the raw images, and of `file`.
  Rectification rectification;
  /// Pixel in the host image, per point.
  std::vector<Eigen::Vector2d> px_host;
  /// Motion of the image, per pose; empty: no motion is known.
  std::vector<ImageMotion> motion;
  /// Motion of the image of a pose; no motion if none is known.
  const ImageMotion& motion_of(int pose) const;
};

/// Unknowns of a profile step, in this order: k1, readout_s.
inline ba::Unknowns unknowns(const ImageCorrection& c) { return {c.k1, c.readout_s}; }
/// Inverse of unknowns().
inline ImageCorrection correction(const ba::Unknowns& k) { return {k[0], k[1]}; }

/// The same problem for an ideal pinhole with a global shutter, if the images are affected by `correction`. A
/// match keeps its residual to first order: with D = d px_file / d px, n^T (p_file - m_file) = (D^T n)^T (p -
/// m); the length of D^T n goes into the sigmas.
BaProblem corrected(const CameraProblem& problem, const ImageCorrection& correction);

/// Derivative of the corrected problem with respect to the unknowns.
ba::GlobalDerivative camera_derivative(const CameraProblem& problem, const ImageCorrection& correction);

/// Limits that an estimate is clamped to, and at which it is not trusted. Seconds for the read-out time.
constexpr double kMaxK1 = kLargestResidualK1, kMaxReadout = 0.1;

/// How an estimate is made, with Gaussian priors around `prior`.
struct CameraSearch {
  /// Value to start at.
  ImageCorrection start;
  /// Free unknowns among k1 and readout_s; the others stay at `start`.
  Eigen::Array<bool, ba::kUnknowns, 1> free{true, false};
  ba::Unknowns prior{0, 0}, prior_sigma{0.01, 0.03}, limit{kMaxK1, kMaxReadout};
};

/// An estimate of the camera.
struct CameraEstimate {
  bool usable = false;
  ImageCorrection value;
  /// Free unknowns of the estimate, among k1 and readout_s.
  Eigen::Array<bool, ba::kUnknowns, 1> free{false, false};
  /// Standard deviation of each unknown, cluster-robust (ProfileStep::score_square): of the free ones by
  /// themselves, of the others as if all were free.
  ba::Unknowns sigma = ba::Unknowns::Zero();
  /// Result of one Newton step from `value` with all unknowns free: what the others appear to be.
  ba::Unknowns if_all_free = ba::Unknowns::Zero();
  /// Cost of the adjustment at `value`.
  double cost = 0;
  /// Poses and depths at `value`.
  BaProblem solution;
};

/// Minimises the profile cost by Newton's method. Cost: about three to five solves.
CameraEstimate estimate_camera(const CameraProblem& problem, const CameraSearch& search,
                               const BaOptions& options);

}  // namespace edgevo
