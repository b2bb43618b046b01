// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Grows one tree of a structured forest.
#include <memory>
#include <vector>

#include "forest_features.h"
#include "forest_labels.h"

namespace edgevo::training {

/// Patch of an image with its true label.
struct Example {
  const FeatureMaps* maps;
  int row, col;
  EdgePatch edges;
};

/// One tree of a forest, by node.
struct Tree {
  /// 0 for a leaf; c for an inner node with the children c - 1 (feature below the threshold) and c.
  std::vector<int> childs;
  std::vector<int> feature_ids;
  std::vector<float> thresholds;
  /// Predicted edges of leaves; empty for inner nodes.
  std::vector<EdgePatch> answers;
};

/// Limits of the growth of a tree.
struct GrowthLimits {
  int depth = 14;
  /// Smallest number of examples in a leaf: fewer are chance.
  int least_examples = 8;
  /// Number of features tried at each node.
  int features_tried = 120;
};

/// Leaf that the patch falls into.
int walk(const Tree& tree, const FeatureMaps& maps, int row, int col);

/// Grows a tree. Cost: about 20 s for 30,000 examples.
Tree grow_tree(const std::vector<const Example*>& examples, const ForestShape& shape,
               const GrowthLimits& limits, Random random);

}  // namespace edgevo::training
