// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Depth for the nodes of a chain that views do not constrain: between two ends of known depth, and at
// corners.
#include <functional>
#include <vector>

#include "edgevo/edge_map/edge_depth.h"

namespace edgevo {

/// Why the depth of a node is certain.
enum class Certain {
  /// It is unknown or too uncertain.
  kNot,
  /// By its own evidence and that of its neighbours.
  kByViews,
  /// Copied from the edge that it meets at a corner.
  kAtCorner,
  /// By a bridge that begins, ends or passes at the node.
  kBetweenEnds,
  /// By a plane of the view, which it lies on (plane_depths.h).
  kOnPlane
};

/// Node of a chain with its final depth.
struct FinalNode {
  /// Edge pixel with its depth, certain or not; idepth 0 if none was found.
  EdgeNode node;
  Certain certain = Certain::kNot;
  /// The part of idepth_sigma that neighbours share.
  double common = 0;
  /// Whether the chain breaks between this node and the next.
  bool breaks = false;

  /// Whether the node belongs to a line. A corner alone does not: the edge that its depth was copied from
  /// covers it already.
  bool is_known() const {
    return certain == Certain::kByViews || certain == Certain::kBetweenEnds || certain == Certain::kOnPlane;
  }
};
/// Nodes along one edge.
using FinalChain = std::vector<FinalNode>;

/// Whether views show the edge of the node at this inverse depth.
using IsShown = std::function<bool(const FinalNode& node, double idepth)>;

/// Bridges straight gaps between two certain ends: the edge is a line in space, so its inverse depth is
/// linear. If the depth of an end was copied at a corner, views must show most of the nodes in between.
void bridge_gaps(const ImageEdges& edges, const IsShown& is_shown, FinalChain* chain);

/// Copies depth at corners. An edge along the motion (a ledge, a sill) ends at an upright edge of known
/// depth, which a node takes over if its own, uncertain depth agrees; it does not if the upright edge is in
/// front. idepth_sigma / idepth of the upright edge must not exceed `max_relative_sigma`.
void copy_depth_at_corners(const ImageEdges& edges, double max_relative_sigma,
                           std::vector<FinalChain>* chains);

}  // namespace edgevo
