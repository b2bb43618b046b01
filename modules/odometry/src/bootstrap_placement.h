// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Poses of the frames of a bootstrap, from the map that it made.
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/odometry/odometry_params.h"
#include "edgevo/odometry/reference.h"
#include "frame_log.h"

namespace edgevo {

/// Tracks the frames between the two views against the finished map. Frames whose image is gone, or that the
/// map does not explain, keep the pose of PnP; the latter are DEGRADED. Cost: one alignment per frame.
void place_bootstrap_frames(const BootstrapResult& bootstrap, const Reference& reference, int segment,
                            const OdometryParams& params, FrameLog* frames);

}  // namespace edgevo
