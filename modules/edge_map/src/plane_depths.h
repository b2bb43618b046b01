// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Depth for nodes of chains from the largest planes of the view (edge_planes.h): of edges along the motion,
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
  /// Whether they have moved it, enough of them, from the depth that was given.
  bool is_measured = false;
};
/// What the views say of a node at an inverse depth.
using WeighNode = std::function<NodeEvidence(const FinalNode& node, double idepth)>;
/// Logarithm of the likelihood of what the views show if the edge has this inverse depth, over that if it
/// lies elsewhere along its ray, or at its `own` inverse depth, unless that is 0.
using CompareDepths = std::function<double(const FinalNode& node, double idepth, double own)>;

struct PlaneLimits {
  double max_idepth = 0;
  /// idepth_sigma / idepth of a node may not exceed it.
  double max_relative_sigma = 0;
};

/// Finds the planes, or corrects those of the keyframe before, as predicted, where no others cover more;
/// refines them with the evidence of the nodes on them, and gives those that have no certain depth, but that
/// views show there rather than elsewhere, the one that the plane has there, the largest plane first. Returns
/// them in `planes`. Around such a node most edges must lie on its plane. If views cannot show that it lies
/// there, since it runs along the motion, edges on both its sides must.
void lay_on_planes(const ImageEdges& edges, const PlaneLimits& limits, const WeighNode& weigh_node,
                   const CompareDepths& compare_depths, std::vector<EdgePlane>* planes,
                   std::vector<FinalChain>* chains);

}  // namespace edgevo
