#pragma once
// What the map files of a run hold: told by report.html, summary.yaml and the closing line of `edgevo map`.
#include <optional>

#include "edgevo/occupancy/grid_map.h"
#include "edgevo/occupancy/octree_map.h"

namespace edgevo {

/// What was written, for those who tell it.
struct MapReport {
  OctreeStats octree;  ///< of edges.ot
  std::optional<OccupancyGrid> grid;  ///< as written
};

}  // namespace edgevo
