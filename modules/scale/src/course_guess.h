// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The most probable course of the scale among those that take one of the measured values at each knot, by
// dynamic programming: however many neighbours are wrong together, the graph then begins at the right side.
//
// The state of a knot is its scale and which sources are at fault. A fault is anything by itself. Wheels that
// slip go on doing so, by as much as before, which costs less than to slip anew.
#include <optional>
#include <vector>

#include "edgevo/map/map_graph.h"

namespace edgevo {

/// What a source measures at a knot; `constraint`, of the scale alone, can fail.
struct KnotMeasurement {
  size_t knot = 0, source = 0;
  Constraint constraint;
  /// Whether a fault of the source goes on.
  bool slips = false;
};

/// The scale at each knot, and which measurements are at fault.
struct CourseGuess {
  std::vector<double> scales;
  std::vector<bool> is_fault;
};

/// `measurements`: at least one, by knot. `links` of each knot to the one before, if anything links them.
/// `drift_variance`: of the logarithm of the scale from one knot to the next. Cost: for one source a few
/// microseconds a knot, for three some hundred.
CourseGuess guess_course(const std::vector<KnotMeasurement>& measurements,
                         const std::vector<std::optional<Constraint>>& links, double drift_variance);

}  // namespace edgevo
