// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which edge points are good enough for a map file. Every output uses the same filter, so that their counts
// agree.
#include <cmath>

#include "edgevo/core/params.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Filter of the points in map files. Defaults: depth known to 15 % (one sigma) and matched in two keyframes,
/// since nothing confirms the depth of a point seen once.
struct PointFilter {
  /// Share of the inverse depth.
  double max_relative_sigma = 0.15;
  /// Keyframes.
  int min_observations = 2;

  /// Names, ranges and texts of the fields (params.h).
  void visit(ParamVisitor& v) {
    v.number(kAdvanced, "max_relative_sigma", max_relative_sigma, 0.001, 10,
             "largest idepth_sigma/idepth of a point in the map files");
    v.integer(kAdvanced, "min_observations", min_observations, 0, 1000,
              "keyframes that must have matched a point");
  }
  /// Whether the point is good enough for the map files.
  bool keeps(const EdgePoint& p) const { return is_valid(p) && is_certain(p) && is_confirmed(p); }

  /// Whether the point is finite and in front of the camera.
  static bool is_valid(const EdgePoint& p) {
    return std::isfinite(p.idepth) && p.idepth > 0 && p.px.allFinite();
  }
  /// Whether the depth is certain enough; an unknown (<= 0) or NaN sigma counts as uncertain.
  bool is_certain(const EdgePoint& p) const {
    return p.idepth_sigma > 0 && p.idepth_sigma <= max_relative_sigma * p.idepth;
  }
  /// Whether enough keyframes matched the point.
  bool is_confirmed(const EdgePoint& p) const { return p.observations >= min_observations; }
};

/// Numbers of points kept and rejected, by the first reason that applies.
struct PointCounts {
  /// Points; kept + invalid + uncertain + unconfirmed = total
  int total = 0, kept = 0, invalid = 0, uncertain = 0, unconfirmed = 0;
};

/// Applies the filter to the points of all keyframes.
PointCounts count_points(const Run& run, const PointFilter& filter);

}  // namespace edgevo
