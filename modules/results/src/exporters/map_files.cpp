// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/gridmap_writer.h"
#include "edgevo/occupancy/color_octree.h"
#include "edgevo/occupancy/edge_ply.h"
#include "edgevo/occupancy/line_table.h"
#include "edgevo/occupancy/map_size.h"
#include "edgevo/run_quality/trusted_part.h"
#include "exporters.h"

namespace edgevo {

void export_points(ExportContext* context, const std::string& path) {
  write_edge_ply(context->run, context->params.occupancy.points, path);
}

void export_doubtful_points(ExportContext* context, const std::string& path) {
  write_edge_ply(doubtful_part(*context->with_doubtful), context->params.occupancy.points, path);
}

bool has_doubtful_points(const ExportContext& context) { return context.with_doubtful != nullptr; }

void export_line_table(ExportContext* context, const std::string& path) {
  write_file(path, line_table_csv(context->run));
}

void export_full_octree(ExportContext* context, const std::string& path) {
  OccupancyParams params = context->params.occupancy;
  context->map.note = coarsen_to_fit(context->run, free_memory(), &params);
  check_map_size(context->run, params, free_memory(), path);
  context->octree.emplace(context->run, params, context->on_keyframe_mapped);
  context->map.octree = context->octree->stats();
  context->octree->write_ot(path);
}

void export_binary_octree(ExportContext* context, const std::string& path) {
  context->octree->write_bt(path);
}

void export_color_octree(ExportContext* context, const std::string& path) {
  write_color_octree(context->run, context->params.occupancy.points, *context->octree, path);
}

bool has_octree(const ExportContext& context) { return context.octree.has_value(); }

void export_grid(ExportContext* context, const std::string& path) {
  const GridParams& params = context->params.grid;
  context->map.grid =
      make_grid(context->run, *context->octree, camera_height_of(context->run, params), params);
  write_ros_grid(*context->map.grid, path);
}

void export_gridmap(ExportContext* context, const std::string& path) {
  write_gridmap(*context->map.grid, path);
}

void export_kept_map(ExportContext* context, const std::string&) { context->kept_map->finish(context->run); }

bool has_kept_map(const ExportContext& context) { return context.kept_map != nullptr; }

bool has_grid(const ExportContext& context) { return context.map.grid.has_value(); }

}  // namespace edgevo
