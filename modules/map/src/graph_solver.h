// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts of MapGraph::solve().
#include <map>

#include "edgevo/map/map_graph.h"
#include "graph_state.h"

namespace edgevo {

/// Added to the normal equations scaled to a diagonal of 1, so that they can be factorised although nothing
/// measures some directions: far above rounding error, far below what a chain of 10,000 links leaves of it.
constexpr double kGraphRegularisation = 1e-13;

/// Minimises over the nodes and modes; leaves the best in `state` and fills all of the solution but the
/// nodes.
void minimise_graph(GraphState* state, GraphSolution* solution);

/// Standard deviations of the log scales of the nodes of `state` that are requested, NaN for the others.
std::vector<double> graph_sigmas(const GraphState& state, MapGraph::Sigmas which);

}  // namespace edgevo
