// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/map/map_graph.h"

namespace edgevo {

/// What a constraint of the scale costs at a residual of its logarithm, in the mode that costs less
/// (map_graph.h), above what its first mode costs at 0. Not for an exact scale.
double scale_cost(const Constraint& constraint, double residual);

}  // namespace edgevo
