#pragma once
// A drive along way points: rounded corners, speed held down in turns, an optional turn on the spot.
#include <string>
#include <vector>

#include "scene_params.h"

namespace edgevo {

struct PathPoint {
  double x, y, yaw;  ///< metres, radians from the x axis to the left
};

/// Where the vehicle is at each of `steps_per_frame` equal steps of time from every frame to the next. Throws
/// InputError: the way ends before the frames do, or a leg is too short for the turn.
std::vector<PathPoint> drive_along(const SceneParams& params, int steps_per_frame, const std::string& where);

}  // namespace edgevo
