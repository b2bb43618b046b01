#pragma once
#include "edgevo/core/records.h"
#include "edgevo/occupancy/occupancy_params.h"

namespace edgevo {

/// The lengths of a map as they are used, in the unit of the run: "auto" is settled by the depth of the
/// points.
struct MapLengths {
  double median_depth = 0;  ///< of the kept points, in their host cameras; 0: no points
  double resolution = 0, max_range = 0;
};
MapLengths map_lengths(const Run& run, const OccupancyParams& params);

}  // namespace edgevo
