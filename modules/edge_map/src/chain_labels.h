#pragma once
// One hypothesis or none for each pixel of a chain: dynamic programming (Viterbi).
#include <vector>

#include "depth_evidence.h"

namespace edgevo {

/// A pixel of a chain: its hypotheses and how many views it costs to have none.
struct ChainNode {
  int edge_pixel = -1;
  double at = 0;  ///< pixels along the chain
  std::vector<Hypothesis> hypotheses;
};

/// For each node the number of its hypothesis, -1: none; `breaks[i]`: depth jumps between node i and i + 1.
/// Cost: nodes times hypotheses squared.
struct ChainLabels {
  std::vector<int> label;
  std::vector<bool> breaks;
};
ChainLabels label_chain(const std::vector<ChainNode>& nodes);

}  // namespace edgevo
