// SPDX-License-Identifier: BSD-3-Clause
// Mutated models of structured forests: refused, or harmless. OpenCV traverses an accepted model without
// checks; the test makes the same traversals with every index checked.
#include "forest_model.h"
#include "fuzz/mutate.h"
#include "support/tiny_forest.h"

namespace edgevo {
namespace {

constexpr int kForestRounds = 10000;

std::vector<int> joined(const std::vector<std::vector<int>>& rows) {
  std::vector<int> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

// Every node that a walk from the root may reach, by either side at each; throws std::out_of_range, or fails
// when it does not end.
void walk(const ForestModel& m, size_t tree) {
  const std::vector<int> boundaries = joined(m.edgeBoundaries), bins = joined(m.edgeBins);
  const int side = m.options.patchSize / m.options.shrinkNumber,
            cells = m.options.selfsimilarityGridSize * m.options.selfsimilarityGridSize;
  const int features = (side * side + cells * (cells - 1) / 2) * m.options.channels();
  const std::vector<char> feature(size_t(features), 0),
      pixel(size_t(m.options.patchInnerSize * m.options.patchInnerSize * m.options.channels()), 0);
  const size_t nodes = m.childs.at(0).size();
  std::vector<size_t> open{0};
  size_t steps = 0;
  while (!open.empty()) {
    ASSERT_LE(++steps, 4 * nodes * nodes + 4) << "endless traversal";
    const size_t at = open.back();
    open.pop_back();
    const int child = m.childs.at(tree).at(at);
    if (child != 0) {
      feature.at(size_t(m.featureIds.at(tree).at(at)));
      m.thresholds.at(tree).at(at);
      open.push_back(size_t(child - 1)), open.push_back(size_t(child));
      continue;
    }
    const size_t node = tree * nodes + at;
    for (int i = boundaries.at(node); i < boundaries.at(node + 1); ++i) pixel.at(size_t(bins.at(size_t(i))));
  }
}

void use(const ForestModel& m) {
  validate_forest(m, "f");
  for (size_t tree = 0; tree < size_t(m.options.numberOfTrees); ++tree) walk(m, tree);
}

TEST(FuzzForest, Text) {
  test::expect_both(test::fuzz(test::forest_text(test::tiny_forest()), kForestRounds, 101,
                               [](const std::string& text) { use(parse_forest(text, "f")); }));
}

// Numbers of the model itself, beyond what mutated text reaches.
TEST(FuzzForest, Numbers) {
  Random random(102);
  int accepted = 0, refused = 0;
  const auto some = [&] {
    return random.below(4) == 0 ? int(random.below(1 << 30)) - (1 << 29) : random.below(16) - 2;
  };
  for (int round = 0; round < kForestRounds; ++round) {
    ForestModel m = test::tiny_forest();
    std::vector<std::vector<int>>* const lists[] = {&m.childs, &m.featureIds, &m.edgeBoundaries, &m.edgeBins};
    int ForestOptions::*const options[] = {&ForestOptions::stride,
                                           &ForestOptions::shrinkNumber,
                                           &ForestOptions::patchSize,
                                           &ForestOptions::patchInnerSize,
                                           &ForestOptions::selfsimilarityGridSize,
                                           &ForestOptions::numberOfTrees,
                                           &ForestOptions::numberOfTreesToEvaluate};
    for (int n = 1 + random.below(3); n > 0; --n) {
      if (random.below(4) == 0) {
        m.options.*options[random.below(7)] = some();
        continue;
      }
      std::vector<int>& row = (*lists[random.below(4)])[size_t(random.below(2))];
      if (row.empty() || random.below(6) == 0)
        row.push_back(some());
      else if (random.below(6) == 0)
        row.pop_back();
      else
        row[size_t(random.below(int(row.size())))] = some();
    }
    try {
      use(m);
      ++accepted;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(accepted, kForestRounds / 50);
  EXPECT_GT(refused, kForestRounds / 2);
}

}  // namespace
}  // namespace edgevo
