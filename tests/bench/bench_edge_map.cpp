// SPDX-License-Identifier: BSD-3-Clause
// Time of the edge map for one keyframe, at 1241x376: the depth of its edges from eight views, and the gray
// levels on their sides.
#include <benchmark/benchmark.h>

#include "bench/bench_scene.h"
#include "edgevo/edge_map/edge_depth.h"

namespace {

using namespace edgevo;

EdgeView view_of(int frame) {
  const auto pyramid = test::pyramid(frame);
  return {pyramid, std::make_shared<const std::vector<EdgeSides>>(sample_sides(pyramid->finest())),
          test::motion(0, frame), 1};
}

// Argument: views. Counters: edge pixels, share of the evaluated ones that get a depth.
void depths_of_a_keyframe(benchmark::State& state) {
  std::vector<EdgeView> views;
  for (int i = 1; i <= int(state.range(0)); ++i) views.push_back(view_of(i % 2 ? 2 * (i + 1) : -2 * i));
  const auto host = test::pyramid(0);
  const std::vector<EdgeSides> sides = sample_sides(host->finest());
  const EdgeMapParams params;
  size_t nodes = 0;
  for (auto _ : state) {
    nodes = 0;
    for (const EdgePiece& piece : find_edge_depths(test::pinhole(), *host, sides, views, 2, params))
      nodes += piece.size();
  }
  const double pixels = double(host->finest().edges.pixels.size());
  state.counters["pixels"] = pixels;
  state.counters["known"] = double(nodes) * params.step_px / pixels;
}
BENCHMARK(depths_of_a_keyframe)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond);

void sides_of_a_keyframe(benchmark::State& state) {
  const auto host = test::pyramid(0);
  for (auto _ : state) benchmark::DoNotOptimize(sample_sides(host->finest()));
}
BENCHMARK(sides_of_a_keyframe)->Unit(benchmark::kMillisecond);

}  // namespace
