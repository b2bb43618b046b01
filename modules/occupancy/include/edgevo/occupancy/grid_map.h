// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A 2D grid for ground planners, from a band of heights of the 3D map.
//
// The band lies between two heights above the ground. The ground is assumed one camera height below the
// nearest keyframe, so that the band follows hills. A cell is occupied if any voxel of its column within the
// band is; else free if any is free; else unknown. The corridor driven by the vehicle, `driven_width` wide,
// is free whatever the map says (only if the height of the ground is known). Unknown is distinguished from
// free: edges are sparse, and space that no ray crossed is unknown.
//
// Cost: linear in the voxels of the map, and in cells times keyframes. World: that of the map files, z up.
#include <string>
#include <vector>

#include "edgevo/core/occupancy_grid.h"
#include "edgevo/core/params.h"
#include "edgevo/core/records.h"
#include "edgevo/occupancy/octree_map.h"

namespace edgevo {

/// Parameters of the grid. Lengths are multiples of the camera height above the ground, so that the defaults
/// hold in any unit: with a camera at 1.65 m the band is from 0.3 to 1.8 m.
struct GridParams {
  /// Length in the unit of the run, or "auto".
  std::string camera_height = "auto";
  /// Camera heights.
  double band_low = 0.18;
  /// Camera heights.
  double band_high = 1.1;
  /// Camera heights.
  double driven_width = 1.1;

  /// Declares names, ranges and help texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
  /// Value of `camera_height`; 0: "auto". Throws InputError for anything else than "auto" or a positive
  /// number.
  double given_camera_height() const;
  /// Throws InputError for an invalid `camera_height` or an empty band.
  void check() const;
};

/// Makes the grid. `camera_height` is that above the ground, in the unit of the run; 0: unknown, in which
/// case the grid contains all heights of the map and its statement says so. An empty map gives one unknown
/// cell.
OccupancyGrid make_grid(const Run& run, const OctreeMap& map, double camera_height, const GridParams& params);

/// Writes the grid for ROS's map_server: a PGM image (rows from the top; 0 occupied, 254 free, 205 unknown)
/// and the YAML file that names it (mode trinary). `yaml_path` ends in .yaml; the image is written next to
/// it. Throws InputError if a file cannot be written.
void write_ros_grid(const OccupancyGrid& grid, const std::string& yaml_path);

}  // namespace edgevo
