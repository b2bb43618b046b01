// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A camera in a rendered scene, steered by ViSP's control laws with the odometry as its only sensor.
//
// Time is simulated, in steps of one image. Each image is taken at the camera's true pose and goes through
// the odometry; its result reaches the servo loop after the time that the odometry took (measured on this
// machine, or a given latency). While the odometry is busy, one image waits and is replaced by newer ones.
// The loop reads the feed once per image, and each command holds until the next. With a given latency, runs
// are bit-identical.
//
// Ground truth is used to evaluate the result, and once for the scale: metres per unit of the map at the
// taught pose, times `scale_error`. A goal taught by the loop's own feed is reached even with a wrong scale.
#include <functional>

#include "edgevo/odometry/odometry.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"

namespace edgevo {

/// Runs the loop. `on_step(seconds)` is called after each image; if it returns false, the loop ends early.
/// Throws InputError for invalid parameters.
ServoResult run_closed_loop(const ServoParams& params, const OdometryParams& odometry,
                            const std::function<bool(double)>& on_step);

}  // namespace edgevo
