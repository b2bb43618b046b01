#pragma once
// Grows one tree of a structured forest.
#include <memory>
#include <vector>

#include "forest_features.h"
#include "forest_labels.h"

namespace edgevo::training {

/// A patch of an image, with its true answer.
struct Example {
  const FeatureMaps* maps;
  int row, col;
  EdgePatch edges;
};

struct Tree {
  std::vector<int> childs;  ///< 0: a leaf; c: nodes c - 1 (feature below the threshold) and c
  std::vector<int> feature_ids;
  std::vector<float> thresholds;
  std::vector<EdgePatch> answers;  ///< of leaves; empty at others
};

struct GrowthLimits {
  int depth = 14;
  int least_examples = 8;    ///< in a leaf: fewer are chance
  int features_tried = 120;  ///< at each node
};

/// The node that the patch falls to.
int walk(const Tree& tree, const FeatureMaps& maps, int row, int col);

/// Cost: about 20 s for 30,000 examples.
Tree grow_tree(const std::vector<const Example*>& examples, const ForestShape& shape,
               const GrowthLimits& limits, Random random);

}  // namespace edgevo::training
