#pragma once
// The lines of a run's edges as a table, one row a line.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// CSV with a header row: line (as in edges.ply), keyframe, frame (of the host), x1 y1 z1 x2 y2 z2 (its ends,
/// in the world of the map files), length (along it), dx dy dz (unit vector from end to end; 0 0 0 of a
/// closed line), sigma (one standard deviation of the depth in its middle), vertices, keyframes (that saw
/// it), straight, outline (0 or 1), gray_dark, gray_bright (means). Lengths in the unit of the run.
std::string line_table_csv(const Run& run);

}  // namespace edgevo
