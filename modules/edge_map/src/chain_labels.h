// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One hypothesis or none for each pixel of a chain: dynamic programming (Viterbi).
#include <vector>

#include "depth_evidence.h"

namespace edgevo {

/// Pixel of a chain with its hypotheses.
struct ChainNode {
  int edge_pixel = -1;
  /// Position along the chain, pixels.
  double at = 0;
  std::vector<Hypothesis> hypotheses;
};

/// Cost of a jump in depth from one node to the next, in views that do not show the edge.
constexpr double kBreakCost = 1.5;

/// Selected hypotheses of a chain.
struct ChainLabels {
  /// Number of the hypothesis of each node; -1: none.
  std::vector<int> label;
  /// Whether depth jumps between node i and i + 1.
  std::vector<bool> breaks;
};
/// Selects the hypotheses of a chain. Cost: nodes times hypotheses squared.
ChainLabels label_chain(const std::vector<ChainNode>& nodes);

}  // namespace edgevo
