#pragma once
// A camera in a rendered scene, steered by ViSP's control laws with the odometry as its only sensor.
//
// Time is the simulation's, in steps of one image: the image is taken at the camera's true pose, goes through
// the odometry, and its result reaches the servo loop as much later as the odometry took (measured on this
// machine, or a given latency); while the odometry is busy a newer image waits and takes the place of an
// older one. The loop asks the feed at its own rate and its command holds until the next. With a given
// latency a run is bit-identical.
//
// Ground truth is used to judge, and once for the scale: what a length of the map is in metres is taken at
// the taught pose, times `scale_error`. A loop that is taught by its own feed does not need it to be right.
#include <functional>

#include "edgevo/odometry/odometry.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"

namespace edgevo {

/// Runs it. `on_step(seconds)` is called after each image; false ends it early. Throws InputError for
/// parameters that cannot be.
ServoResult run_closed_loop(const ServoParams& params, const OdometryParams& odometry,
                            const std::function<bool(double)>& on_step);

}  // namespace edgevo
