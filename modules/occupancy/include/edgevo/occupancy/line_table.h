// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The 3D lines of a run as a table, one row a line.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// CSV with a header row: line (as in edges.ply), keyframe, frame (of the host), x1 y1 z1 x2 y2 z2 (ends,
/// in the world of the map files), length (along the line), dx dy dz (unit vector from end to end; 0 0 0 for
/// a closed line), sigma (standard deviation of the depth at the middle), vertices, keyframes (number of
/// observers), straight, outline (0 or 1), gray_dark, gray_bright (means), views (other
/// images that showed it), source (of its depth: views, plane). Lengths in the unit of the run.
std::string line_table_csv(const Run& run);

}  // namespace edgevo
