// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Maps of a run for planners: octree and grid. RunOutputs writes them at the end of a run; `edgevo map`
// writes them again at any resolution.
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/occupancy/grid_map.h"
#include "edgevo/occupancy/occupancy_params.h"
#include "edgevo/occupancy/octree_map.h"
#include "edgevo/report/map_report.h"

namespace edgevo {

/// Parameters of the maps for planners.
struct MapParams {
  /// Parameters of the octree.
  OccupancyParams occupancy;
  /// Parameters of the 2D grid.
  GridParams grid;

  /// Declares names, ranges and help texts of the fields (core/params.h).
  void visit(ParamVisitor& v) {
    {
      const auto g = v.group("occupancy");
      occupancy.visit(v);
    }
    {
      const auto g = v.group("grid");
      grid.visit(v);
    }
  }
  /// Throws InputError if parameters contradict each other.
  void check() const { occupancy.check(), grid.check(); }
};

/// Writes edges.ot, edges.bt, grid.yaml, grid.pgm and grid.gridmap.gz into `folder`, which is made if
/// necessary. A file that fails does not keep the others from being written; the first failure is thrown at
/// the end (InputError). An octree that does not fit into the free memory is not begun.
MapReport write_map_files(const Run& run, const MapParams& params, const std::string& folder,
                          const OnKeyframeMapped& on_keyframe_mapped = {});

/// Height of the camera over the ground, unit of the run. Taken from the first of these that is known: the
/// parameter, --scale, the edges of the ground, the mount; 0: none is.
double camera_height_of(const Run& run, const GridParams& params);

}  // namespace edgevo
