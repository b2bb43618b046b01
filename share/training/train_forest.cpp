// SPDX-License-Identifier: BSD-3-Clause
// edgevo_train_forest OUT.yml.gz [SEED] [FRAMES] [train|lasting]: renders its training set and grows a
// structured forest from it. FRAMES 0 uses the number of the plan. The same seed gives the same file. Method:
// Dollar and Zitnick, "Fast Edge Detection Using Structured Forests" (PAMI 2015).
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/core/run_parallel.h"
#include "forest_file.h"
#include "training_set.h"

namespace edgevo::training {
namespace {

constexpr int kPatches = 150;      // per piece
constexpr double kWithEdge = 0.6;  // share of them at an edge: otherwise half of all would be empty

EdgePatch edges_at(const cv::Mat& label, int row, int col, const ForestShape& shape) {
  EdgePatch edges;
  for (int v = 0; v < kInner; ++v)
    for (int u = 0; u < kInner; ++u)
      edges[size_t(v * kInner + u)] = label.at<uint8_t>(row * shape.stride + v, col * shape.stride + u) != 0;
  return edges;
}

// Whether an edge passes through the centre of the patch.
bool has_edge(const EdgePatch& edges) {
  for (int v = kInner / 2 - 2; v < kInner / 2 + 2; ++v)
    for (int u = kInner / 2 - 2; u < kInner / 2 + 2; ++u)
      if (edges[size_t(v * kInner + u)]) return true;
  return false;
}

void add_examples(const Sample& sample, const FeatureMaps& maps, const ForestShape& shape, Random random,
                  std::deque<Example>* examples) {
  const int rows = (sample.label.rows - kInner) / shape.stride + 1,
            cols = (sample.label.cols - kInner) / shape.stride + 1;
  int wanted_with = int(kPatches * kWithEdge), wanted_without = kPatches - wanted_with;
  for (int tries = 0; tries < 20 * kPatches && wanted_with + wanted_without > 0; ++tries) {
    const int row = random.below(std::min(rows, maps.rows())),
              col = random.below(std::min(cols, maps.cols()));
    const EdgePatch edges = edges_at(sample.label, row, col, shape);
    int& wanted = has_edge(edges) ? wanted_with : wanted_without;
    if (wanted == 0) continue;
    --wanted;
    examples->push_back({&maps, row, col, edges});
  }
}

// Each tree uses half of the examples, so that trees differ.
std::vector<const Example*> half_of(const std::deque<Example>& examples, Random& random) {
  std::vector<const Example*> chosen;
  for (const Example& e : examples)
    if (random.uniform() < 0.5) chosen.push_back(&e);
  return chosen;
}

void train(const std::string& out, uint64_t seed, int frames, const std::string& set) {
  Plan plan = plan_named(set);
  plan.seed = seed;
  if (frames > 0) plan.frames = frames;
  const ForestShape shape;
  const std::vector<Sample> samples = make_samples(plan);
  std::printf("%zu pieces\n", samples.size());
  std::deque<FeatureMaps> maps;
  std::deque<Example> examples;
  for (size_t i = 0; i < samples.size(); ++i) {
    maps.emplace_back(samples[i].gray, shape);
    add_examples(samples[i], maps.back(), shape, Random::derive(seed, 0x70617463 + i), &examples);
  }
  std::printf("%zu patches\n", examples.size());
  std::vector<Tree> trees(size_t(shape.trees));
  run_parallel(0, shape.trees, 2, [&](int t) {
    Random random = Random::derive(seed, 0x74726565 + uint64_t(t));
    trees[size_t(t)] = grow_tree(half_of(examples, random), shape, GrowthLimits(), random);
    std::printf("tree %d: %zu nodes\n", t, trees[size_t(t)].childs.size());
    std::fflush(stdout);
  });
  write_forest(out, std::move(trees), shape);
}

}  // namespace
}  // namespace edgevo::training

int main(int argc, char** argv) try {
  if (argc < 2)
    throw edgevo::InputError("edgevo_train_forest", "no output file is given",
                             "write edgevo_train_forest OUT.yml.gz [SEED] [FRAMES] [train|lasting]");
  edgevo::training::train(argv[1], argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1,
                          argc > 3 ? std::atoi(argv[3]) : 0, argc > 4 ? argv[4] : "train");
  return 0;
} catch (const edgevo::InputError& e) {
  std::fprintf(stderr, "edgevo_train_forest: %s\n", e.what());
  return 2;
}
