// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Depth for nodes of chains from the largest plane of the view (edge_planes.h): of edges along the motion,
// which views do not constrain, and of those that too few views show to find them without a guess.
#include <functional>
#include <optional>
#include <vector>

#include "chain_gaps.h"
#include "depth_evidence.h"
#include "edge_planes.h"

namespace edgevo {

/// What the views say of a node at a guessed inverse depth.
struct NodeEvidence {
  Hypothesis hypothesis;
  /// Standard deviation of the error that all views share.
  double common = 0;
  /// Whether the views show the edge there rather than elsewhere along its ray, or at its own depth.
  bool is_likely = false;
  /// Whether they have moved it, enough of them, from the depth that was given.
  bool is_measured = false;
};
/// `own`: the node's inverse depth if it differs, else 0.
using WeighNode = std::function<NodeEvidence(const FinalNode& node, double idepth, double own)>;

struct PlaneLimits {
  double max_idepth = 0;
  /// idepth_sigma / idepth of a node may not exceed it.
  double max_relative_sigma = 0;
};

/// Finds the plane, or corrects that of the keyframe before, as predicted, if no other covers more; refines
/// it with the evidence of the nodes on it, and gives those that have no certain depth, but that views
/// show there rather than elsewhere, the one that it has there. Returns it in `plane`; none if there is none.
/// Around such a node most edges must lie on the plane. If views cannot show that it lies there, since it
/// runs along the motion, edges on both its sides must.
void lay_on_plane(const ImageEdges& edges, const PlaneLimits& limits, const WeighNode& weigh_node,
                  std::optional<EdgePlane>* plane, std::vector<FinalChain>* chains);

}  // namespace edgevo
