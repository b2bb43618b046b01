#pragma once
// The occupied voxels of an edge map in the gray of their edges, as octomap::ColorOcTree, for octovis.
#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"
#include "edgevo/occupancy/octree_map.h"

namespace edgevo {

/// Writes an .ot file with the occupied voxels of `map`, made from `run` with the same `filter`: each has the
/// mean gray of the points and lines within, free space is left out. Cost: one look-up for
/// each vertex and each voxel between two. Throws InputError when it cannot be written.
void write_color_octree(const Run& run, const PointFilter& filter, const OctreeMap& map,
                        const std::string& path);

}  // namespace edgevo
