// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Edges as PLY, for MeshLab, CloudCompare, Open3D: first the points used by tracking, then the lines, vertex
// by vertex.
//
// Binary little endian, for each vertex: float x y z (T_map_world(run): z up, x forward; unit of the run,
// stated in a comment), uchar red green blue (the gray value of the host image), float idepth and
// idepth_sigma (1/z in the host camera and its standard deviation), int keyframe (index of the host), int
// observations (for a line: keyframes that observed it), int line (-1: a point), uchar gray_dark gray_bright
// (on the two sides of the edge), views (255: or more) and line_kind (bits; 1: straight, 2: outline, 4: depth
// by a plane). Element `edge` joins the vertices of a line. The range is not limited: filter by idepth and
// idepth_sigma if necessary. A run without points gives a valid file with zero vertices. Comments hold the
// keyframes' poses, unit and mount, so that any map can be rebuilt from this file alone (edge_ply_reader.h).
// The bytes depend on the run alone.
#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Writes the points that pass `filter`, and all lines. Returns the number of points. Throws InputError if
/// the file cannot be written.
int write_edge_ply(const Run& run, const PointFilter& filter, const std::string& path);

}  // namespace edgevo
