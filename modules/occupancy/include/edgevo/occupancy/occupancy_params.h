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
  /// length or "auto": resolution_share of the median depth, at most 0.2 metres
  std::string resolution = "auto";
  /// share of the median depth
  double resolution_share = 0.02;
  /// length or "auto": max_range_share of the median depth
  std::string max_range = "auto";
  /// in median depths
  double max_range_share = 2.0;
  /// share of the inverse depth
  double carve_max_relative_sigma = 0.05;
  /// points
  int carve_neighbours = 3;
  /// probability
  double prob_hit = 0.7;
  /// probability
  double prob_miss = 0.4;
  /// which points are mapped
  PointFilter points;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
  /// The given number; 0 stands for "auto". Throws InputError for anything but "auto" and positive numbers.
  double given_resolution() const;
  /// As given_resolution().
  double given_max_range() const;
  /// Throws InputError when a text is neither "auto" nor a positive number.
  void check() const;
};

}  // namespace edgevo
