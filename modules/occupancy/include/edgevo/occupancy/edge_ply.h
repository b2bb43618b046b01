#pragma once
// The edges as PLY, for MeshLab, CloudCompare, Open3D: first the points that tracking used, then the lines,
// vertex by vertex.
//
// Binary little endian, for each vertex: float x y z (T_map_world(run): z up, x forward; unit of the run,
// stated in a comment), uchar red green blue (the gray value of the host image), float idepth and
// idepth_sigma (1/z in the host camera and its standard deviation), int keyframe (index of the host), int
// observations (of a line: keyframes that saw it), int line (-1: a point), uchar gray_dark gray_bright (on
// the two sides of the edge) and line_kind (1: straight, 2: an outline). Element `edge` joins the vertices of
// a line. No cap on the range here: who needs one can filter by idepth and idepth_sigma. No points give a
// valid file of zero vertices. Comments hold the keyframes' poses, unit and mount, so that any map can be
// built again from this file alone (edge_ply_reader.h). The bytes depend on the run alone.
#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Writes the points that pass `filter`, and all lines; returns how many points. Throws InputError when the
/// file cannot be written.
int write_edge_ply(const Run& run, const PointFilter& filter, const std::string& path);

}  // namespace edgevo
