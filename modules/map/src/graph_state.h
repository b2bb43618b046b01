// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The graph as arrays: what is free, what is fixed, and where it is now.
#include <array>
#include <map>
#include <vector>

#include "edgevo/map/map_graph.h"
#include "graph_residual.h"

namespace edgevo {

/// A constraint, ready to be evaluated.
struct GraphTerm {
  /// The constraint and its id.
  Constraint constraint;
  int id = 0;
  /// Indices of its nodes.
  int from = 0, to = 0;
  /// Its modes; `mode` is the present one: 0 the first, 1 the failure.
  std::vector<GraphMode> modes;
  int mode = 0;
};

/// Nodes and constraints of one solve.
struct GraphState {
  /// What may move: unit quaternion x y z w and translation of each node, and the logarithm of the scale of
  /// each group, at the index of its root.
  struct Values {
    std::vector<std::array<double, 7>> poses;
    std::vector<double> log_scales;
  };

  /// From guesses and constraints; the nodes of a group take their scale from the root.
  GraphState(const std::map<NodeId, Sim3>& guesses, const std::map<int, Constraint>& constraints);

  /// T_world_node of the node at an index.
  Sim3 node(int index) const;

  /// The nodes in their order; the world is the first.
  std::vector<NodeId> ids;
  /// Index of the root of each node's group, and log s(node) - log s(root).
  std::vector<int> root;
  std::vector<double> offset;
  /// Whether a node's pose is fixed; whether the scale of a root is.
  std::vector<bool> pose_fixed, scale_fixed;
  /// Whether constraints tie a node to the world at all; whether measured or exact scales do.
  std::vector<bool> tied, scale_tied;
  /// Those constraints that have something to evaluate, by id.
  std::vector<GraphTerm> terms;
  /// Where the nodes are.
  Values values;
};

}  // namespace edgevo
