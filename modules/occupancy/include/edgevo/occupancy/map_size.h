// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Estimate of the size of an octree before it is built: voxels ten times too small take up to a thousand
// times the memory, and even smaller ones cover only the surroundings of the first camera.
//
// Rays are sampled on cells so coarse that this takes less than a second. The number of voxels is
// extrapolated from the growth of the number of cells when their size is halved (by 8 for a full volume, by 2
// for single rays). The result is an upper bound, since rays diverge at finer resolutions.
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/occupancy/occupancy_params.h"

namespace edgevo {

/// Estimated size of a map.
struct MapSize {
  /// Voxel size that will be used, unit of the run.
  double resolution = 0;
  /// Number of free and occupied voxels.
  double voxels = 0;
  /// Memory for building and writing the map, bytes.
  double bytes = 0;
  /// Share of the points in range that lie outside the octree (32768 voxels from the origin), 0 to 1.
  double outside_share = 0;
};

/// Estimates the size of the map of a run. Cost: half a second for any run.
MapSize estimate_map_size(const Run& run, const OccupancyParams& params);

/// Throws InputError if the map does not fit into `free_bytes` or some points would lie outside; the message
/// begins with `where` and gives the finest possible resolution (two digits). Throws InputError also if a
/// given resolution is coarser than the whole run. Cost: negligible for a small map.
void check_map_size(const Run& run, const OccupancyParams& params, double free_bytes,
                    const std::string& where);

/// Where the resolution is "auto" and voxels of that size would not hold the run (reach, memory, grid), sets
/// a coarser one that does. Returns what was done as a sentence; empty: nothing. A given resolution is left
/// to check_map_size(). Cost: negligible for a small map, else half a second for each half again as coarse.
std::string coarsen_to_fit(const Run& run, double free_bytes, OccupancyParams* params);

/// Memory available to programs on this machine, bytes, as reported by the system.
double free_memory();

}  // namespace edgevo
