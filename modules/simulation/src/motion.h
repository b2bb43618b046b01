#pragma once
// How the camera moves: poses at each frame, scene axes (x east, y north, z up), metres.
#include <string>
#include <vector>

#include "edgevo/core/se3.h"
#include "scene_params.h"

namespace edgevo {

/// Poses T_scene_cam of all frames. Throws InputError naming `where`, e.g. when the way ends before the frames do.
std::vector<SE3> make_trajectory(const SceneParams& params, uint64_t seed, const std::string& where);

/// A camera at `position` that looks along yaw (radians from x to the left), `down` radians under the horizon, and is rolled
/// clockwise by `roll`.
SE3 look(const Eigen::Vector3d& position, double yaw, double down, double roll);

}  // namespace edgevo
