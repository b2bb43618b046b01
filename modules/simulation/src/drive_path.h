// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A drive along waypoints: rounded corners, reduced speed in turns, an optional pure rotation.
#include <string>
#include <vector>

#include "scene_params.h"

namespace edgevo {

struct PathPoint {
  /// Position in metres and yaw in radians from the x axis to the left.
  double x, y, yaw;
};

/// Poses of the vehicle at `steps_per_frame` equal steps of time between successive frames. Throws
/// InputError: the path ends before the frames do, or a leg is too short for its turn.
std::vector<PathPoint> drive_along(const SceneParams& params, int steps_per_frame, const std::string& where);

/// Duration of the drive once along all waypoints, seconds. Throws InputError as drive_along().
double seconds_along(const SceneParams& params, const std::string& where);

}  // namespace edgevo
