#pragma once
// A 2D grid for planners on the ground, from a band of heights of the 3D map.
//
// The band lies between two heights over the ground. The ground is where the camera's way is, one camera
// height lower: over each cell that of the nearest keyframe counts, so that the band follows hills. A cell is
// occupied if any voxel of its column in the band is; else free if any is free; else unknown. Where the
// vehicle itself has been nothing stands, whatever the map says: its way, `driven_width` wide, is free (only
// where the ground is known: else nobody knows that there is a vehicle). Unknown is kept apart from free:
// edges are sparse, and what no ray crossed is not known.
//
// Cost: linear in the voxels of the map, and cells times keyframes within reach. World: that of the map
// files, z up.
#include <string>
#include <vector>

#include "edgevo/core/occupancy_grid.h"
#include "edgevo/core/params.h"
#include "edgevo/core/records.h"
#include "edgevo/occupancy/octree_map.h"

namespace edgevo {

/// Lengths in camera heights over the ground, so that the defaults hold whatever the unit of the run is: with
/// a camera at 1.65 m the band is from 0.3 to 1.8 m.
struct GridParams {
  /// length or "auto"
  std::string camera_height = "auto";
  /// camera heights
  double band_low = 0.18;
  /// camera heights
  double band_high = 1.1;
  /// camera heights
  double driven_width = 1.1;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
  /// The given height; 0 stands for "auto". Throws InputError for anything but "auto" and positive numbers.
  double given_camera_height() const;
  /// Throws InputError also for an empty band.
  void check() const;
};

/// `camera_height`: over the ground, unit of the run; 0: nobody knows it. Then all heights of the map are in
/// the grid, and its statement says so. An empty map gives a grid of one unknown cell.
OccupancyGrid make_grid(const Run& run, const OctreeMap& map, double camera_height, const GridParams& params);

/// ROS's map_server: a PGM image (rows from the top; 0 occupied, 254 free, 205 unknown) and the YAML file
/// that names it (trinary). `yaml_path` ends in .yaml, the image lies beside it. Throws InputError when a
/// file cannot be written.
void write_ros_grid(const OccupancyGrid& grid, const std::string& yaml_path);

}  // namespace edgevo
