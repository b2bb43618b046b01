// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Nodes whose scales are tied exactly share one scale: log s = log s(root) + offset.
#include <map>
#include <optional>

#include "edgevo/map/map_graph.h"

namespace edgevo {

/// Disjoint groups of nodes; the root of a group is its first node, so that the world is always a root.
class ScaleGroups {
 public:
  /// Root of a node's group, and log s(node) - log s(root).
  struct Member {
    NodeId root;
    double offset;
  };
  /// A node that was never tied is alone.
  Member find(NodeId id) const;
  /// log s(to) - log s(from), if they are tied.
  std::optional<double> between(NodeId from, NodeId to) const;
  /// Ties two nodes with log s(to) - log s(from) = `log_ratio`; nothing if they are tied already.
  void tie(NodeId from, NodeId to, double log_ratio);

 private:
  std::map<NodeId, Member> parent_;
};

}  // namespace edgevo
