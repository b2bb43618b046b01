// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The occupied voxels of an edge map in the gray of their edges, as octomap::ColorOcTree, for octovis.
#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"
#include "edgevo/occupancy/octree_map.h"

namespace edgevo {

/// Writes an .ot file with the occupied voxels of `map`, made from `run` with the same `filter`: each has the
/// mean gray of the points and lines within. Free space is not written. Cost: one look-up for each vertex and
/// for each voxel between two vertices. Throws InputError if the file cannot be written.
void write_color_octree(const Run& run, const PointFilter& filter, const OctreeMap& map,
                        const std::string& path);

}  // namespace edgevo
