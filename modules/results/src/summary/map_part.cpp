// SPDX-License-Identifier: BSD-3-Clause
#include "summary_parts.h"

namespace edgevo {

void write_map(const Run& run, const MapReport& report, YamlWriter* y) {
  const OctreeStats& map = report.octree;
  const OccupancyGrid none;
  const OccupancyGrid& grid = report.grid ? *report.grid : none;
  y->open("map");
  y->text("axes", "x forward, y left, z up");
  y->text("up", run.T_vehicle_cam ? "of the vehicle, by the mount of the camera"
                                  : "of the first camera, assumed to look straight forward");
  y->integer("points", map.points.total);
  y->integer("points_exported", map.points.kept);
  y->integer("points_invalid", map.points.invalid);
  y->integer("points_uncertain", map.points.uncertain);
  y->integer("points_unconfirmed", map.points.unconfirmed);
  int64_t lines = 0, straight = 0, vertices = 0;
  for (const KeyframeRecord& k : run.keyframes)
    for (const EdgeLine& line : k.lines)
      ++lines, straight += line.is_straight, vertices += int64_t(line.vertices.size());
  y->integer("lines", lines);
  y->integer("lines_straight", straight);
  y->integer("line_vertices", vertices);
  y->number("median_depth", map.median_depth, 6);
  y->number("voxel_size", map.resolution, 6);
  y->number("voxel_range", map.max_range, 6);
  y->integer("voxel_points_beyond_range", map.beyond_range);
  y->integer("voxel_points_out_of_bounds", map.out_of_bounds);
  y->integer("voxel_rays", map.rays);
  y->integer("voxels_occupied", map.occupied_voxels);
  y->integer("voxels_free", map.free_voxels);
  y->text("grid", grid.statement);
  y->integer("grid_width", grid.width);
  y->integer("grid_height", grid.height);
  if (map.points.kept == 0) y->text("note", "no point passed the filter: the map files are valid but empty");
  if (!report.note.empty()) y->text("coarser", report.note);
  y->close();
}

}  // namespace edgevo
