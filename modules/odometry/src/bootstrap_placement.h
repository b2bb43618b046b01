#pragma once
// The frames of a bootstrap get their poses from the map that it made.
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/odometry/reference.h"
#include "run_records.h"

namespace edgevo {

/// Frames between the two views are tracked against the finished map; those whose image is gone, or that the
/// map does not explain, keep the pose of PnP. A pose that the map does not explain is DEGRADED. Cost: one
/// alignment a frame.
void place_bootstrap_frames(const BootstrapResult& bootstrap, const Reference& reference, int segment,
                            const AlignmentParams& params, RunRecords* records);

}  // namespace edgevo
