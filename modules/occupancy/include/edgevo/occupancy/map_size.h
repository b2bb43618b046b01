#pragma once
// How large the octree of a run gets, before it is built: a voxel too small by ten takes up to a thousand
// times the memory, and one too small by more reaches only the surroundings of the first camera.
//
// Rays are sampled on cells so coarse that this is done in a second; how the count of cells grows from those
// twice as large tells that of the voxels (a full volume by 8, single rays by 2). An upper estimate: single
// rays separate.
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/occupancy/occupancy_params.h"

namespace edgevo {

/// An estimate before the map is made.
struct MapSize {
  double resolution = 0;  ///< edge of a voxel as it will be used, unit of the run
  double voxels = 0;      ///< free and occupied, about
  double bytes = 0;       ///< of memory while it is built and written, about
  double outside_share =
      0;  ///< of the points in range: beyond the 32768 voxels from the origin that an octree has
};

/// Cost: half a second for any run.
MapSize estimate_map_size(const Run& run, const OccupancyParams& params);

/// Throws InputError when the map cannot be held in `free_bytes`, or would leave points outside; the message,
/// opened by `where`, names the smallest resolution (two digits) that will do. Likewise when a resolution
/// that was given is coarser than the whole run. Cost: next to none where the map is small.
void check_map_size(const Run& run, const OccupancyParams& params, double free_bytes,
                    const std::string& where);

/// Bytes that programs can still have on this machine, as the system tells it.
double free_memory();

}  // namespace edgevo
