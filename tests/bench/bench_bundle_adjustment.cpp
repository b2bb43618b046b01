// SPDX-License-Identifier: BSD-3-Clause
// Time of one window solve by both solvers: 7 poses, 2500 points, about 10k and 15k observations, with noise
// and outliers. Counters: observations of the window, iterations of the solve, milliseconds per iteration
// (set-up and results included).
#include <benchmark/benchmark.h>

#include "support/bundle_adjustment_scene.h"

namespace {

using namespace edgevo;

BaProblem window(double observed_share) {
  test::SceneOptions o;
  o.points = 2500;
  o.observed_share = observed_share;
  o.noise_px = 0.5;
  o.outlier_share = 0.1;
  o.fixed_point_share = 0.1;
  return test::perturb(test::make_scene(o), 0.03, 0.005, 0.1, 7);
}

void solve(benchmark::State& state, const char* solver) {
  const BaProblem start = window(static_cast<double>(state.range(0)) / 100);
  const auto adjuster = make_bundle_adjuster(solver);
  BaOptions options;
  options.relative_decrease = 0;  // every run does all its iterations
  int iterations = 0;
  for (auto _ : state) {
    state.PauseTiming();
    BaProblem problem = start;
    state.ResumeTiming();
    iterations += adjuster->solve(&problem, options).iterations;
  }
  state.counters["observations"] = static_cast<double>(start.observations.size());
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(state.iterations());
  state.counters["s_per_iteration"] =
      benchmark::Counter(iterations, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void marginalize_oldest(benchmark::State& state) {
  BaProblem problem = window(static_cast<double>(state.range(0)) / 100);
  for (BaPose& pose : problem.poses) pose.fixed = false;
  std::vector<bool> drop;
  for (auto _ : state) benchmark::DoNotOptimize(marginalize(problem, 100, BaOptions(), &drop));
}

BENCHMARK_CAPTURE(solve, schur, "schur")->Arg(67)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, ceres, "ceres")->Arg(67)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(marginalize_oldest)->Arg(67)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
