// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// "Up" by the accelerometer next to a gyro, for a camera that is carried anyhow.
//
// Over a second the mean of what it feels, turned into the world, is gravity, the change of the velocity, and
// its bias as the camera was turned meanwhile:
//     mean(R_world_cam R_cam_gyro a) = g + s dv / dt + mean(R_world_cam R_cam_gyro) b
// g, b and the length s of a unit follow from all seconds by least squares with Huber weights. s is a
// nuisance: it is not used for the scale.
#include <optional>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/records.h"
#include "edgevo/gyro/gyro_model.h"
#include "edgevo/scale/up_direction.h"

namespace edgevo {

/// Up in the axes of the world of `run`, which are those of the first camera; its poses must be final.
/// Nothing where fewer than five seconds have poses without a gap, or where what was measured is not as long
/// as gravity. Cost: 1 microsecond a sample.
std::optional<UpEstimate> up_by_gravity(const Run& run, const std::vector<GyroSample>& samples,
                                        const GyroModel& gyro);

}  // namespace edgevo
