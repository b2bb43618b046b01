// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motion of the camera, at the frames and between them; scene axes (x east, y north, z up), metres.
#include <string>
#include <vector>

#include "edgevo/core/se3.h"
#include "scene_params.h"

namespace edgevo {

/// Poses at equal steps of time from 0 s, joined at constant velocity, which continues beyond both ends.
struct CameraMotion {
  double step_s = 0;
  /// Poses, two or more.
  std::vector<SE3> T_scene_cam;

  SE3 at(double seconds) const;
};

constexpr int kStepsPerFrame = 50;

/// The motion, in kStepsPerFrame steps a frame, so that step kStepsPerFrame i is frame i. Throws InputError
/// naming `where`, for instance when the path ends before the frames do.
CameraMotion make_trajectory(const SceneParams& params, uint64_t seed, const std::string& where,
                             uint64_t draw = 0);

/// A camera at `position` that looks along yaw (radians from x to the left), `down` radians below the
/// horizon, and is rolled clockwise by `roll`.
SE3 look(const Eigen::Vector3d& position, double yaw, double down, double roll);

}  // namespace edgevo
