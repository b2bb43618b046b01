// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/records.h"
#include "edgevo/occupancy/occupancy_params.h"

namespace edgevo {

/// Lengths of a map in the unit of the run, with "auto" replaced by shares of the depth of the points.
struct MapLengths {
  /// Median depth of the kept points in their host cameras; 0: no points.
  double median_depth = 0;
  /// Voxel size and largest range.
  double resolution = 0, max_range = 0;
};
/// Computes the lengths for the map of a run.
MapLengths map_lengths(const Run& run, const OccupancyParams& params);

}  // namespace edgevo
