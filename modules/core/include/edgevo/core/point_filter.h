#pragma once
// Which edge points are good enough for a map file. Every output uses the same filter, so that their counts
// agree.
#include <cmath>

#include "edgevo/core/params.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Defaults: depth known to 15 % (one sigma) and matched in two keyframes; the depth of a point seen once is
/// confirmed by nothing.
struct PointFilter {
  /// share of the inverse depth
  double max_relative_sigma = 0.15;
  /// keyframes
  int min_observations = 2;

  /// Names, ranges and texts of the fields (params.h).
  void visit(ParamVisitor& v) {
    v.number(kAdvanced, "max_relative_sigma", max_relative_sigma, 0.001, 10,
             "largest idepth_sigma/idepth of a point in the map files");
    v.integer(kAdvanced, "min_observations", min_observations, 0, 1000,
              "keyframes that must have matched a point");
  }
  /// good enough for the map files
  bool keeps(const EdgePoint& p) const { return is_valid(p) && is_certain(p) && is_confirmed(p); }

  /// In front of the camera and finite.
  static bool is_valid(const EdgePoint& p) {
    return std::isfinite(p.idepth) && p.idepth > 0 && p.px.allFinite();
  }
  /// Negated so that an unknown (<= 0) or undefined sigma counts as uncertain.
  bool is_certain(const EdgePoint& p) const {
    return p.idepth_sigma > 0 && p.idepth_sigma <= max_relative_sigma * p.idepth;
  }
  /// matched in enough keyframes
  bool is_confirmed(const EdgePoint& p) const { return p.observations >= min_observations; }
};

/// How many points passed, and why the others did not (the first reason counts).
struct PointCounts {
  /// points; kept + invalid + uncertain + unconfirmed = total
  int total = 0, kept = 0, invalid = 0, uncertain = 0, unconfirmed = 0;
};

PointCounts count_points(const Run& run, const PointFilter& filter);  ///< Over the points of all keyframes.

}  // namespace edgevo
