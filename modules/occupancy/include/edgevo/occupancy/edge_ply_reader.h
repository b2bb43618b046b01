// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The map of a finished run, read back from its edges.ply, to build other maps from.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// Returns the run's keyframes with their exported points and lines, poses and segments, unit and mount, but
/// no frames. The camera of the result is a pinhole of focal length 1, to which the points' px refer. Lengths
/// have the file's single precision. Throws InputError: no such file, not an edges.ply of edgevo, no keyframe
/// poses (written by an older version), or a truncated file.
Run read_edge_ply(const std::string& path);

}  // namespace edgevo
