// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Statistics of the map files of a run, for report.html, summary.yaml and the closing line of `edgevo map`.
#include <optional>
#include <string>

#include "edgevo/occupancy/grid_map.h"
#include "edgevo/occupancy/octree_map.h"

namespace edgevo {

/// Statistics and contents of the map files.
struct MapReport {
  /// Statistics of edges.ot.
  OctreeStats octree;
  /// The 2D grid as written; nullopt: none was.
  std::optional<OccupancyGrid> grid;
  /// Why the voxels are coarser than intended; empty where they are not.
  std::string note;
};

}  // namespace edgevo
