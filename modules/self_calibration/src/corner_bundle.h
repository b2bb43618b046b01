// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A bundle adjustment of corners alone, with the focal length free.
#include <optional>
#include <vector>

#include "edgevo/core/rectification.h"
#include "edgevo/core/se3.h"
#include "edgevo/self_calibration/focal_by_corners.h"

namespace edgevo {

/// The corners of one image, by ascending id, and the camera's pose in the odometry's path.
struct FeatureObservations {
  SE3 T_cam_path;
  /// Rays by the camera file alone.
  std::vector<FollowedCorner> corners;
};

/// Adjusts poses, depths and focal length to the corners of `views`, three or more; `lens`: what is known of
/// it, where the search starts. Nothing: too few corners, or no minimum. The standard deviation is that of
/// errors which are common to neighbouring corners and images, as those of followed patches are.
std::optional<FocalError> adjust_corners(const Rectification& rectification,
                                         const std::vector<FeatureObservations>& views,
                                         const ImageCorrection& lens);

}  // namespace edgevo
