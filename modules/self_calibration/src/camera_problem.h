#pragma once
// A bundle adjustment whose images carry what the camera file does not say, a residual radial distortion and
// a rolling shutter (edges/image_correction.h), and the search for both.
#include <Eigen/Core>
#include <vector>

#include "edgevo/bundle_adjustment/profile.h"
#include "edgevo/edges/image_correction.h"

namespace edgevo {

/// A BaProblem as the camera FILE sees it: `file.observations[i].px` and `.normal` and `px_host` are in the
/// images that the file's model yields; `file.points[i].ray` is not used.
struct CameraProblem {
  BaProblem file;
  std::vector<Eigen::Vector2d> px_host;  ///< per point
  std::vector<ImageMotion> motion;       ///< per pose, of its image; empty: none is known
  const ImageMotion& motion_of(int pose) const;
};

/// The unknowns of a profile step in their order: k1, readout_s.
inline ba::Unknowns unknowns(const ImageCorrection& c) { return {c.k1, c.readout_s}; }
inline ImageCorrection correction(const ba::Unknowns& k) { return {k[0], k[1]}; }

/// The same problem for a true pinhole with a global shutter, if the images carry `correction`. A match keeps
/// its residual to first order: with D = d px_file / d px, n^T (p_file - m_file) = (D^T n)^T (p - m); the
/// length of D^T n goes into the sigmas.
BaProblem corrected(const CameraProblem& problem, const ImageCorrection& correction);

/// How that problem changes with the unknowns.
ba::GlobalDerivative camera_derivative(const CameraProblem& problem, const ImageCorrection& correction);

/// Sizes that an estimate is clamped to; at them it is not believed. Seconds for the read-out time.
constexpr double kMaxK1 = 0.03, kMaxReadout = 0.1;

/// How an estimate is made. Gaussian priors around `prior`.
struct CameraSearch {
  ImageCorrection start;
  /// k1, readout_s; what is not free stays at its start.
  Eigen::Array<bool, ba::kUnknowns, 1> free{true, false};
  ba::Unknowns prior{0, 0}, prior_sigma{0.01, 0.03}, limit{kMaxK1, kMaxReadout};
};

struct CameraEstimate {
  bool usable = false;
  ImageCorrection value;
  Eigen::Array<bool, ba::kUnknowns, 1> free{false, false};  ///< as in the estimate
  /// One standard deviation of each, cluster-robust (ProfileStep::score_square): of the free ones by
  /// themselves, of the others if all were free.
  ba::Unknowns sigma = ba::Unknowns::Zero();
  /// One Newton step from `value` with all unknowns free: what the others seem to be.
  ba::Unknowns if_all_free = ba::Unknowns::Zero();
  double cost = 0;     ///< at `value`
  BaProblem solution;  ///< poses and depths at `value`
};

/// Newton's method on the profile cost. Cost: about three to five solves.
CameraEstimate estimate_camera(const CameraProblem& problem, const CameraSearch& search,
                               const BaOptions& options);

}  // namespace edgevo
