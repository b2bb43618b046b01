#pragma once
// Depth for the nodes of a chain that views tell none of: between two ends of known depth, and at corners.
#include <functional>
#include <vector>

#include "edgevo/edge_map/edge_depth.h"

namespace edgevo {

/// Whence the depth of a node is certain.
enum class Certain {
  kNot,         ///< views tell none, or too uncertain a one
  kByViews,     ///< its own and its neighbours' evidence
  kAtCorner,    ///< lent by the edge that it meets there
  kBetweenEnds  ///< by a bridge that begins, ends or passes there
};

/// What is known of a node of a chain.
struct SettledNode {
  EdgeNode node;  ///< idepth 0: none was found; else one, certain or not
  Certain certain = Certain::kNot;
  bool breaks = false;  ///< no connection to the next one

  /// A corner alone is no news: the edge that lends the depth tells it already.
  bool is_known() const { return certain == Certain::kByViews || certain == Certain::kBetweenEnds; }
};
using SettledChain = std::vector<SettledNode>;

/// Whether views show an edge at the node where this inverse depth says.
using IsShown = std::function<bool(const SettledNode& node, double idepth)>;

/// A straight stretch between two certain ends is one line of space: its inverse depth is linear. Where an
/// end is lent, most nodes between must be shown there.
void bridge_gaps(const EdgeMap& edges, const IsShown& is_shown, SettledChain* chain);

/// An edge along the motion (a ledge, a sill) ends at a corner, whose upright edge has a depth: it is lent to
/// a node whose own, uncertain one agrees. Where the upright edge stands in front it does not.
/// A lender's idepth_sigma / idepth is at most `max_relative_sigma`.
void lend_at_corners(const EdgeMap& edges, double max_relative_sigma, std::vector<SettledChain>* chains);

}  // namespace edgevo
