// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A 2D grid as MRPT's COccupancyGridMap2D, for its navigators, planners and viewers.
#include <string>

#include "edgevo/core/occupancy_grid.h"

namespace edgevo {

/// Writes `path` (grid.gridmap.gz): the serialised map, gzip-compressed. Free cells hold 0.99, occupied ones
/// 0.01, unknown ones 0.5 (probability of being free). Throws InputError when it cannot be written.
void write_gridmap(const OccupancyGrid& grid, const std::string& path);

}  // namespace edgevo
