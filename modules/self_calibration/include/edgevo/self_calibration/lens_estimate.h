// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The whole camera from the matches of a map: focal length, principal point and radial distortion that the
// camera file has wrong, each with its standard deviation. For a camera that is hardly known
// (calibration/camera_from_motion.h); a run itself corrects k1, the read-out time and the focal
// length (self_calibration.h).
#include <Eigen/Core>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/core/rectification.h"
#include "edgevo/map/map.h"

namespace edgevo {

/// Factor from the standard deviations of the matches to those of the camera, with k1 and k2 free. Matches of
/// an edge in many keyframes are not independent, and are biased towards the prediction: over ten runs with
/// cameras that are known, the focal length was off by 0.5 to 6 of the former, 2.8 of them rms
/// (lab 2026-11-26_camera_from_motion).
constexpr double kSigmasOfMatches = 3;

/// What is known of the camera beforehand: standard deviations of the file's values.
struct LensPrior {
  /// Relative, of the focal length.
  double focal = 0.3;
  /// Of k1 and k2; 0: held at zero.
  double k1 = 0.1, k2 = 0;
  /// Of the principal point, over the focal length; 0: held.
  double centre = 0.05;
};

/// What the file has wrong: x_file = (1 + focal) x (1 + k1 r^2 + k2 r^4) + centre, normalised coordinates.
struct LensEstimate {
  /// False if the adjustment found no minimum; then nothing else is set.
  bool usable = false;
  /// True focal length over that of the file, less 1.
  double focal = 0;
  /// Residual radial distortion.
  double k1 = 0, k2 = 0;
  /// True principal point less that of the file, over the file's focal length.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  /// Standard deviations, of the matches alone (cluster-robust, by keyframe); 0 for what was held. Matches
  /// are biased towards the prediction of their own map, which these do not contain.
  double focal_sigma = 0, k1_sigma = 0, k2_sigma = 0;
  /// Of both coordinates of the principal point.
  Eigen::Vector2d centre_sigma = Eigen::Vector2d::Zero();
  /// Robust cost per observation: about 0.5 where the matches are as exact as they claim.
  double cost = 0;
  /// Number of keyframes and of observations.
  int keyframes = 0, observations = 0;
};

/// Adjusts all keyframes of the map that have matches, with the camera. The map must be made without a
/// correction of the camera. Cost: about half a second at 60 keyframes.
LensEstimate estimate_lens(const Rectification& rectification, const Map& map, const LensPrior& prior,
                           const BaOptions& options);

}  // namespace edgevo
