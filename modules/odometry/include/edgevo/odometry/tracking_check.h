#pragma once
// How far off are tracked poses, measured while running? The adjustment moves each new keyframe from where
// tracking had put it. That move, against the covariance that tracking told, says how much the reference's
// own error adds, which no residual of tracking shows: factor = 1.15 max(0.7, mean of normalised_error_square
// / 5). Measured on rendered scenes: share/lab/archive/2026-11-22_pose_covariance.md.
#include "edgevo/core/se3.h"

namespace edgevo {

/// Running estimate of the factor above.
class TrackingCheck {
 public:
  /// A keyframe's pose against its reference, as tracked with its covariance, and as adjusted. Poses or
  /// covariances that are not finite are left out. Cost: a Cholesky factor of 6 x 6.
  void add(const SE3& T_cam_ref_tracked, const SE3& T_cam_ref_adjusted, const Matrix6d& covariance);

  /// Variance of a tracked pose over the covariance that its alignment told, 0.8 to 4.6; 2.3 before the first
  /// keyframe.
  double error_factor() const;

 private:
  // A map from two views errs more than one of a full window: normalised error squared of the first dozen
  // frames of rendered scenes.
  static constexpr double kYoungMap = 2;
  double mean_ = kYoungMap;  // of the normalised error squared, the newest keyframes weighing most
};

}  // namespace edgevo
