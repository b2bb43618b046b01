// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pose of a single image in a map that was kept.
#include "edgevo/core/se3.h"

namespace edgevo {

/// Id of the keyframe of a frame that was located: it has none.
constexpr int kNoKeyframe = -1;

/// Images within which a camera is located, where it can be: the first map of a run waits for them, since its
/// motion and unit follow from such poses.
constexpr int kImagesToLocate = 6;

/// Where an image was taken from.
struct LocatedPose {
  /// Pose of the camera in the world of the kept map, in its unit.
  SE3 T_world_cam;
  /// Covariance of xi in T_cam_world <- exp(xi) T_cam_world, tangent [v, w].
  Matrix6d covariance = Matrix6d::Zero();
  /// Median depth of what the map shows there, in its unit.
  double median_depth = 1;
};

}  // namespace edgevo
