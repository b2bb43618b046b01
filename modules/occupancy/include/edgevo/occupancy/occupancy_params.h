#pragma once
// Parameters of the occupancy map.
#include <string>

#include "edgevo/core/params.h"
#include "edgevo/core/point_filter.h"

namespace edgevo {

/// Lengths are in the unit of the run (metres or arbitrary, see Run::scale_source). Since a monocular unit is
/// arbitrary, the defaults are shares of the median depth of the points: at 12 m median depth voxels of 0.24
/// m and a range of 24 m.
struct OccupancyParams {
  std::string resolution =
      "auto";  ///< edge of a voxel; "auto": resolution_share of the median depth, at most 0.2 metres
  double resolution_share = 0.02;  ///< of the median depth, > 0
  std::string max_range = "auto";  ///< nothing farther from the path is mapped; "auto": max_range_share
  double max_range_share = 2.0;    ///< of the median depth, > 0
  double carve_max_relative_sigma = 0.05;  ///< only points at least this certain carve free space
  double carve_stop_sigmas = 3.0;  ///< rays stop this many sigmas of depth (and a voxel) before the point
  int carve_neighbours = 3;        ///< a point carves when this many others of its segment lie near it
  double carve_neighbour_share = 0.03;  ///< near: within this share of its range (at most of twice max_range)
  /// Probabilities, per keyframe: of a voxel with a point and of one that a ray crosses.
  double prob_hit = 0.7,
         prob_miss = 0.4;  ///< per keyframe, of a voxel with a point and of one that a ray crosses
  bool fill = false;       ///< walls without texture, framed by straight edges, are occupied
  double fill_prob = 0.6;  ///< of their voxels: less than that of a point seen once
  PointFilter points;      ///< which points are mapped

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
  /// The given number; 0 stands for "auto". Throw InputError for anything but "auto" and positive numbers.
  double given_resolution() const;
  double given_max_range() const;  ///< likewise
  /// Throws InputError when a text is neither "auto" nor a positive number.
  void check() const;
};

}  // namespace edgevo
