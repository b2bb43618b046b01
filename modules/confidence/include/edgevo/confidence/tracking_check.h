// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Measures the error of tracked poses during a run. The adjustment moves each new keyframe from where
// tracking had put it. That move, relative to the covariance of tracking, shows how much the reference's own
// error adds, which no residual of tracking shows: factor = 1.15 max(0.7, mean of normalised_error_square /
// 5). Measured on rendered scenes: lab 2026-11-22_pose_covariance.
#include "edgevo/core/se3.h"

namespace edgevo {

/// Running estimate of the error factor.
class TrackingCheck {
 public:
  /// Adds a keyframe's pose against its reference, as tracked with its covariance, and as adjusted. Poses or
  /// covariances that are not finite are skipped. Returns normalised_error_square / 5 of this keyframe. Cost:
  /// a Cholesky factorisation of 6 x 6.
  double add(const SE3& T_cam_ref_tracked, const SE3& T_cam_ref_adjusted, const Matrix6d& covariance);

  /// Variance of a tracked pose over the variance that its alignment reports, 0.8 to 4.6; 2.3 before the
  /// first keyframe.
  double error_factor() const;

 private:
  // A map from two views has a larger error than a full window: mean normalised error squared of the first
  // dozen frames of rendered scenes.
  static constexpr double kYoungMap = 2;
  double mean_ = kYoungMap;  // of the normalised error squared; the newest keyframes weigh most
};

}  // namespace edgevo
