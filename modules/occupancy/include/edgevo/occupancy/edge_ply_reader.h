#pragma once
// A finished run's map, read back from its edges.ply: enough to build any map of it again.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// The keyframes with the points that the run exported, their poses and segments, unit and mount; no frames.
/// The camera of the result is a pinhole of focal length 1, to which the points' px refer. Lengths are exact
/// to the file's single precision. Throws InputError: not there, not an edges.ply of edgevo, without keyframe
/// poses (written by an older version), cut short.
Run read_edge_ply(const std::string& path);

}  // namespace edgevo
