// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parameters of the occupancy map.
#include <string>

#include "edgevo/core/params.h"
#include "edgevo/core/point_filter.h"

namespace edgevo {

/// Parameters of the occupancy map. Lengths are in the unit of the run (metres or arbitrary, see
/// Run::scale_source). The defaults are shares of the median depth of the points: at a median depth of 12 m,
/// voxels of 0.24 m and a range of 24 m.
struct OccupancyParams {
  /// Length in the unit of the run, or "auto": resolution_share of the median depth, at most 0.2 metres or
  /// what a pixel spans at that depth.
  std::string resolution = "auto";
  /// Share of the median depth.
  double resolution_share = 0.02;
  /// Length in the unit of the run, or "auto": max_range_share of the median depth.
  std::string max_range = "auto";
  /// Multiple of the median depth.
  double max_range_share = 2.0;
  /// Share of the inverse depth.
  double carve_max_relative_sigma = 0.05;
  /// Number of points.
  int carve_neighbours = 3;
  /// Probability.
  double prob_hit = 0.7;
  /// Probability.
  double prob_miss = 0.4;
  /// Filter of the points that are mapped.
  PointFilter points;

  /// Declares names, ranges and help texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
  /// Value of `resolution`; 0: "auto". Throws InputError for anything else than "auto" or a positive number.
  double given_resolution() const;
  /// Value of `max_range`; 0: "auto". Throws InputError for anything else than "auto" or a positive number.
  double given_max_range() const;
  /// Throws InputError if `resolution` or `max_range` is neither "auto" nor a positive number.
  void check() const;
};

}  // namespace edgevo
