// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A bundle adjustment whose images are affected by what the camera file has wrong (camera_error.h), and the
// search for it.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "camera_error.h"
#include "edgevo/bundle_adjustment/profile.h"
#include "edgevo/core/records.h"
#include "edgevo/self_calibration/lens_estimate.h"

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
  /// Whether the newest keyframe was made in doubt: the map may be wrong by more than the camera is.
  bool is_in_doubt = false;
  /// Motion of the image of a pose; no motion if none is known.
  const ImageMotion& motion_of(int pose) const;
};

/// Where a pixel of `file` lies in the image of the ideal camera: the normalised point x, and d x_file / dx.
struct IdealPoint {
  Eigen::Vector2d x;
  Eigen::Matrix2d jacobian;
};
/// Those of all host pixels and matches, in their order: the costly part of what follows.
struct IdealPoints {
  std::vector<IdealPoint> hosts, matches;
};
/// Computes them for a camera file with this `error`.
IdealPoints ideal_points(const CameraProblem& problem, const CameraError& error);

/// The same problem for an ideal pinhole with a global shutter, if the camera file has such an error. A
/// match keeps its residual to first order: with D = d px_file / d px, n^T (p_file - m_file) = (D^T n)^T (p -
/// m); the length of D^T n goes into the sigmas.
BaProblem corrected(const CameraProblem& problem, const IdealPoints& points);
/// The same with points computed for `error`.
BaProblem corrected(const CameraProblem& problem, const CameraError& error);

/// Derivative of the corrected problem with respect to the unknowns; `points`: those of `error`.
ba::GlobalDerivative camera_derivative(const CameraProblem& problem, const CameraError& error,
                                       const IdealPoints& points);

/// Limits that an estimate is clamped to, and at which it is not trusted. Seconds for the read-out time.
constexpr double kMaxK1 = kLargestCameraError[0], kMaxReadout = kLargestCameraError[1],
                 kMaxK2 = kLargestCameraError[2], kMaxFocal = kLargestCameraError[3], kMaxCentre = 0.2;

/// How an estimate is made, with Gaussian priors around `prior`.
struct CameraSearch {
  /// Value to start at.
  CameraError start;
  /// Free unknowns; the others stay at `start`.
  CameraMask free = only({kK1});
  ba::Unknowns prior = ba::Unknowns::Zero(),
               limit = of_each(kMaxK1, kMaxReadout, kMaxK2, kMaxFocal, kMaxCentre),
               /// In units of the matches' own: the largest error of a file is a standard deviation.
      prior_sigma = limit / kSigmasOfMatches;
};

/// An estimate of the camera.
struct CameraEstimate {
  bool usable = false;
  CameraError value;
  /// Free unknowns of the estimate.
  CameraMask free = only({});
  /// Standard deviation of each free unknown, cluster-robust (ProfileStep::score_square); 0 of the others.
  ba::Unknowns sigma = ba::Unknowns::Zero();
  /// Their covariance, of the same kind.
  ba::UnknownsSquare covariance = ba::UnknownsSquare::Zero();
  /// Cost of the adjustment at `value`.
  double cost = 0;
  /// Poses and depths at `value`.
  BaProblem solution;
};

/// Minimises the profile cost by Newton's method. Cost: about three to five solves.
CameraEstimate estimate_camera(const CameraProblem& problem, const CameraSearch& search,
                               const BaOptions& options);

}  // namespace edgevo
