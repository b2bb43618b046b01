// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which of the relations between epochs hold, and the units that follow: where the minimisation of the graph
// of units begins, which then finds the nearest minimum.
#include <cstddef>
#include <vector>

#include "edgevo/map/map_graph.h"

namespace edgevo {

/// A constraint of the scale alone between two epochs, by their positions in time order.
struct UnitRelation {
  /// The epochs; different ones.
  size_t from = 0, to = 0;
  /// The constraint.
  Constraint constraint;
};

/// Logarithms of the units of `epochs` epochs over that of the first. From the most probable value of each
/// relation: while there is a relation that would hold, and the sum of the costs of all fall, if all epochs
/// from one on, or one alone, had other units, they get them. Deterministic. Cost: for each epoch the square
/// of the number of relations that span its beginning, a tenth of a microsecond each.
std::vector<double> guess_units(size_t epochs, const std::vector<UnitRelation>& relations);

}  // namespace edgevo
