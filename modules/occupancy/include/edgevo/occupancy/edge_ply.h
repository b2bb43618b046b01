#pragma once
// The edge points as a PLY point cloud, for MeshLab, CloudCompare, Open3D.
//
// Binary little endian, one vertex a point: float x y z (T_map_world(run): z up, x forward; unit of the run,
// stated in a comment), uchar red green blue (the gray value of the host image), float idepth and
// idepth_sigma (1/z in the host camera and its standard deviation), int keyframe (index of the host), int
// observations. No cap on the range here: who needs one can filter by idepth and idepth_sigma. No points give
// a valid file of zero vertices. Comments hold the keyframes' poses, unit and mount, so that any map can be
// built again from this file alone (edge_ply_reader.h). The bytes depend on the run alone.
#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Writes the points that pass `filter`; returns how many. Throws InputError when the file cannot be written.
int write_edge_ply(const Run& run, const PointFilter& filter, const std::string& path);

}  // namespace edgevo
