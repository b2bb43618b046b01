#include "edgevo/results/run_maps.h"

#include "edgevo/mrpt_bridge/gridmap_writer.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/scale_source.h"

namespace edgevo {

double camera_height_of(const Run& run, const GridParams& params) {
  if (const double given = params.given_camera_height(); given > 0) return given;
  const ScaleSource source = parse_scale_source(run.scale_source);
  if (source.kind == ScaleSource::Kind::kCameraHeight) return source.value;
  if (const auto seen = seen_camera_height(run, ScaleParams())) return *seen;
  if (run.is_metric() && run.T_vehicle_cam && run.T_vehicle_cam->translation().z() > 0) return run.T_vehicle_cam->translation().z();
  return 0;
}

MapReport write_map_files(const Run& run, const MapParams& params, const WriteOne& write_one) {
  MapReport report;
  std::optional<OctreeMap> octree;
  write_one("edges.ot", [&](const auto& path) {
    octree.emplace(run, params.occupancy);
    report.octree = octree->stats();
    octree->write_ot(path);
  });
  if (!octree) return report;
  write_one("edges.bt", [&](const auto& path) { octree->write_bt(path); });
  write_one("grid.yaml", [&](const auto& path) {
    report.grid = make_grid(run, *octree, camera_height_of(run, params.grid), params.grid);
    write_ros_grid(*report.grid, path);
  });
  if (report.grid) write_one("grid.gridmap.gz", [&](const auto& path) { write_gridmap(*report.grid, path); });
  return report;
}

}  // namespace edgevo
