#pragma once
// The maps of a run for planners: octree and grid. `edgevo run` writes them at its end, `edgevo map` again at any resolution.
#include <functional>
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/occupancy/grid_map.h"
#include "edgevo/occupancy/occupancy_params.h"
#include "edgevo/report/map_report.h"

namespace edgevo {

struct MapParams {
  OccupancyParams occupancy;
  GridParams grid;

  void visit(ParamVisitor& v) {
    { const auto g = v.group("occupancy"); occupancy.visit(v); }
    { const auto g = v.group("grid"); grid.visit(v); }
  }
  void check() const { occupancy.check(), grid.check(); }
};

/// Does `write(path)` for the file `name`; it may catch what that throws.
using WriteOne = std::function<void(const std::string& name, const std::function<void(const std::string& path)>& write)>;

/// Writes edges.ot, edges.bt, grid.yaml, grid.pgm and grid.gridmap.gz, each by `write_one`.
MapReport write_map_files(const Run& run, const MapParams& params, const WriteOne& write_one);

/// How high the camera is over the ground, unit of the run: as given, as --scale gave it, as the edges of the ground show it, as the mount
/// says; 0 if none of them tells.
double camera_height_of(const Run& run, const GridParams& params);

}  // namespace edgevo
