// SPDX-License-Identifier: BSD-3-Clause
#include "forest_tree.h"

#include <algorithm>
#include <numeric>

namespace edgevo::training {
namespace {

struct Split {
  int feature = -1;
  float threshold = 0;
  double impurity = 1e30;
};

// Gini impurity of two classes, times the number of examples.
double impurity(double ones, double count) { return count > 0 ? 2 * ones * (count - ones) / count : 0; }

// Best threshold of one feature, found by sorting the examples.
void try_feature(int id, std::vector<std::pair<float, uint8_t>>& values, int least, Split* best) {
  std::sort(values.begin(), values.end());
  double all = 0, ones = 0;
  for (const auto& v : values) all += v.second;
  const int n = int(values.size());
  for (int i = 0; i + 1 < n; ++i) {
    ones += values[size_t(i)].second;
    if (values[size_t(i)].first == values[size_t(i + 1)].first || i + 1 < least || n - i - 1 < least)
      continue;
    const double sum = impurity(ones, i + 1) + impurity(all - ones, n - i - 1);
    if (sum < best->impurity) *best = {id, values[size_t(i + 1)].first, sum};
  }
}

class Grower {
 public:
  Grower(const ForestShape& shape, const GrowthLimits& limits, Random random)
      : shape_(shape), limits_(limits), random_(random) {}

  Tree grow(std::vector<const Example*> examples) {
    add_node();
    std::vector<Task> tasks{{0, 0, std::move(examples)}};
    for (size_t i = 0; i < tasks.size(); ++i) {  // breadth first: children come after their parent
      const Task task = std::move(tasks[i]);
      split_or_end(task, &tasks);
    }
    return std::move(tree_);
  }

 private:
  struct Task {
    int node, depth;
    std::vector<const Example*> examples;
  };

  void add_node() {
    tree_.childs.push_back(0), tree_.feature_ids.push_back(0), tree_.thresholds.push_back(0),
        tree_.answers.emplace_back();
  }

  void split_or_end(const Task& task, std::vector<Task>* tasks) {
    const Split split = best_split(task);
    if (split.feature < 0) return end(task);
    const int child = int(tree_.childs.size()) + 1;
    add_node(), add_node();
    tree_.childs[size_t(task.node)] = child;
    tree_.feature_ids[size_t(task.node)] = split.feature;
    tree_.thresholds[size_t(task.node)] = split.threshold;
    Task below{child - 1, task.depth + 1, {}}, above{child, task.depth + 1, {}};
    for (const Example* e : task.examples)
      (e->maps->at(e->row, e->col, split.feature) < split.threshold ? below : above).examples.push_back(e);
    tasks->push_back(std::move(below));
    tasks->push_back(std::move(above));
  }

  Split best_split(const Task& task) {
    Split best;
    if (task.depth >= limits_.depth || int(task.examples.size()) < 2 * limits_.least_examples) return best;
    const std::vector<uint8_t> classes = two_classes(answers_of(task), random_);
    const auto ones = std::count(classes.begin(), classes.end(), 1);
    if (ones == 0 || size_t(ones) == classes.size()) return best;
    best.impurity = impurity(double(ones), double(classes.size())) * (1 - 1e-9);  // a split must improve
    std::vector<std::pair<float, uint8_t>> values(task.examples.size());
    for (int i = 0; i < limits_.features_tried; ++i) {
      const int id = random_.below(shape_.features());
      for (size_t k = 0; k < values.size(); ++k) {
        const Example& e = *task.examples[k];
        values[k] = {e.maps->at(e.row, e.col, id), classes[k]};
      }
      try_feature(id, values, limits_.least_examples, &best);
    }
    return best;
  }

  static std::vector<const EdgePatch*> answers_of(const Task& task) {
    std::vector<const EdgePatch*> answers;
    for (const Example* e : task.examples) answers.push_back(&e->edges);
    return answers;
  }

  void end(const Task& task) { tree_.answers[size_t(task.node)] = most_typical(answers_of(task)); }

  ForestShape shape_;
  GrowthLimits limits_;
  Random random_;
  Tree tree_;
};

}  // namespace

int walk(const Tree& tree, const FeatureMaps& maps, int row, int col) {
  int node = 0;
  while (tree.childs[size_t(node)] != 0) {
    const bool below = maps.at(row, col, tree.feature_ids[size_t(node)]) < tree.thresholds[size_t(node)];
    node = tree.childs[size_t(node)] - (below ? 1 : 0);
  }
  return node;
}

Tree grow_tree(const std::vector<const Example*>& examples, const ForestShape& shape,
               const GrowthLimits& limits, Random random) {
  return Grower(shape, limits, random).grow(examples);
}

}  // namespace edgevo::training
