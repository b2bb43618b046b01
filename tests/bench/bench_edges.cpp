// SPDX-License-Identifier: BSD-3-Clause
// Time of each step from an image to its edge pyramid, at 1241x376. Counter: edge pixels.
#include <benchmark/benchmark.h>

#include "bench/bench_scene.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/edges/edge_extraction.h"

namespace {

using namespace edgevo;

const Gradient& gradient() {
  static const Gradient g = compute_gradient(test::image(0).view());
  return g;
}

void gradient_of_image(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(compute_gradient(test::image(0).view()));
}

void detect(benchmark::State& state, const char* name) {
  EdgeParams params;
  params.detector = name;
  const auto detector = make_edge_detector(params);
  for (auto _ : state) benchmark::DoNotOptimize(detector->detect({test::image(0).view(), gradient()}));
}

void extract(benchmark::State& state) {
  const EdgeParams params;
  const auto mask = make_edge_detector(params)->detect({test::image(0).view(), gradient()});
  size_t edges = 0;
  for (auto _ : state) edges = extract_edges(mask, gradient(), params.min_chain).pixels.size();
  state.counters["edges"] = double(edges);
}

void nearest_field(benchmark::State& state) {
  const ImageEdges& edges = test::pyramid(0)->finest().edges;
  for (auto _ : state) benchmark::DoNotOptimize(NearestField(edges, int(state.range(0))));
  state.counters["edges"] = double(edges.pixels.size());
}

enum class Look { kAsIs, kLens, kLensAndRows };

// With and without a lens distortion and a rolling shutter to correct.
void whole_pyramid(benchmark::State& state, Look look) {
  PyramidBuilder builder(test::scene().camera, EdgeParams());
  ImageMotion motion;
  motion.velocity << 0.5, 0.3, -8, 0.02, 0.05, 0.01;
  motion.idepth.setConstant(0.1);
  if (look != Look::kAsIs) builder.set_correction({0.01, look == Look::kLensAndRows ? 0.02 : 0.0});
  size_t edges = 0;
  for (auto _ : state) edges = builder.build(test::image(0), motion)->finest().edges.pixels.size();
  state.counters["edges"] = double(edges);
}

BENCHMARK(gradient_of_image)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detect, canny, "canny")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detect, edge_drawing, "edge_drawing")->Unit(benchmark::kMillisecond);
BENCHMARK(extract)->Unit(benchmark::kMillisecond);
BENCHMARK(nearest_field)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_pyramid, as_is, Look::kAsIs)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_pyramid, lens, Look::kLens)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_pyramid, lens_and_rolling_shutter, Look::kLensAndRows)->Unit(benchmark::kMillisecond);

}  // namespace
