#pragma once
// How the camera moves, at each frame and between them; scene axes (x east, y north, z up), metres.
#include <string>
#include <vector>

#include "edgevo/core/se3.h"
#include "scene_params.h"

namespace edgevo {

/// Poses at equal steps of time from 0 s on, joined at constant velocity, which also goes on beyond both
/// ends.
struct CameraMotion {
  double step_s = 0;
  std::vector<SE3> T_scene_cam;  ///< two or more

  SE3 at(double seconds) const;
};

constexpr int kStepsPerFrame = 50;

/// The motion, in kStepsPerFrame steps a frame, so that step kStepsPerFrame i is frame i. Throws InputError
/// naming `where`, e.g. when the way ends before the frames do.
CameraMotion make_trajectory(const SceneParams& params, uint64_t seed, const std::string& where);

/// A camera at `position` that looks along yaw (radians from x to the left), `down` radians under the
/// horizon, and is rolled clockwise by `roll`.
SE3 look(const Eigen::Vector3d& position, double yaw, double down, double roll);

}  // namespace edgevo
