#pragma once
// The maps of a run for planners: octree and grid. RunOutputs writes them at the end of a run, `edgevo map` again at any
// resolution.
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/occupancy/grid_map.h"
#include "edgevo/occupancy/occupancy_params.h"
#include "edgevo/occupancy/octree_map.h"
#include "edgevo/report/map_report.h"

namespace edgevo {

/// Parameters of the maps for planners.
struct MapParams {
  OccupancyParams occupancy;  ///< of the octree
  GridParams grid;  ///< of the 2D grid

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v) {
    { const auto g = v.group("occupancy"); occupancy.visit(v); }
    { const auto g = v.group("grid"); grid.visit(v); }
  }
  void check() const { occupancy.check(), grid.check(); }  ///< throws InputError
};

/// Writes edges.ot, edges.bt, grid.yaml, grid.pgm and grid.gridmap.gz into `folder`, which is made if need
/// be. One that cannot be written does not keep the others from being tried; the first failure is thrown
/// (InputError). An octree that the free memory does not hold is not begun.
MapReport write_map_files(const Run& run, const MapParams& params, const std::string& folder,
                          const OnKeyframeMapped& on_keyframe_mapped = {});

/// How high the camera is over the ground, unit of the run: as given, as --scale gave it, as the edges of the ground show it,
/// as the mount says; 0 if none of them tells.
double camera_height_of(const Run& run, const GridParams& params);

}  // namespace edgevo
