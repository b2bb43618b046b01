// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Geometry>

namespace edgevo {

/// Where a camera looks whose pose is not known.
struct Heading {
  /// Rotation from the frame of the keyframe poses to the camera.
  Eigen::Quaterniond R_cam_map = Eigen::Quaterniond::Identity();
  /// Covariance of w in R <- exp(w) R, which grows with the time since the last pose.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

}  // namespace edgevo
