// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A first look at the beginning of a recording, for what its camera file does not say and its first map
// depends on: the read-out time of a rolling shutter.
//
// A map that is made of bent rows keeps what they have done to it: matches were looked for where rows that
// are straight would be, and its unit changes until the read-out time has converged. So the first frames are
// followed until it has, and then all are followed from the beginning, with that time. A gyro, which is next
// to most rolling shutters, then sits as the first fit of it says, since none of the turns that it is fitted
// to were bent. Images are looked at at a half of their size, or less (at_a_glance() in first_look.cpp).
#include <functional>
#include <optional>

#include "edgevo/core/records.h"
#include "edgevo/odometry/odometry.h"
#include "first_frames.h"

namespace edgevo {

/// Whether a run takes a first look: a recording with a gyro, whose frames wait, of a camera whose read-out
/// time is to be found. Without a gyro, or on a schedule, it is found on the way.
bool takes_first_look(const ImageSource& source, const OdometryParams& params,
                      const OdometryOptions& options);

/// The camera by the first frames of `source`, if its shutter rolls. Cost: 20 ms for each of up to
/// kMostLookedAt frames, whose images are kept.
std::optional<CameraPosterior> first_look(FirstFrames* source, OdometryParams params, OdometryOptions options,
                                          const std::function<bool()>& stop);

}  // namespace edgevo
