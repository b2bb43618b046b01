// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Poses of the frames of a bootstrap, from the map that it made.
#include <optional>
#include <vector>

#include "edgevo/alignment/reference.h"
#include "edgevo/alignment/tracker.h"
#include "edgevo/map/frame_log.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/tracking/tracking_params.h"

namespace edgevo {

/// Pose of a view against the reference of the finished map. The two views that made it are keyframes: the
/// first and the newest.
SE3 pose_in_map(const BootstrapView& view, const BootstrapResult& bootstrap, const Reference& reference);

/// For each view its alignment with the finished map; nothing if it has no pose, or its image is gone.
using BootstrapTracks = std::vector<std::optional<TrackResult>>;
/// Tracks the views against the finished map. Cost: one alignment per view.
BootstrapTracks track_bootstrap_frames(const BootstrapResult& bootstrap, const Reference& reference,
                                       const TrackingParams& params);

/// Gives the frames of the bootstrap their poses: those of `tracks`. Frames whose image is gone, or that the
/// map does not explain, keep the pose of PnP; the latter are DEGRADED.
void place_bootstrap_frames(const BootstrapResult& bootstrap, const BootstrapTracks& tracks,
                            const Reference& reference, int segment, const TrackingParams& params,
                            FrameLog* frames);

}  // namespace edgevo
