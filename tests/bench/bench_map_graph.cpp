// SPDX-License-Identifier: BSD-3-Clause
// Time of MapGraph::solve(): 10,000 keyframes with scales of their own and 60,000 constraints, the drive of
// tests/support/graph_scene.h. Arguments: keyframes, percent of mistaken places. Counters: CPU seconds of the
// thread, steps of the minimisation, peak memory of the process in MB.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "edgevo/core/thread_clock.h"
#include "support/graph_scene.h"

namespace {

using namespace edgevo;

void solve(benchmark::State& state) {
  test::GraphSceneOptions o;
  o.keyframes = static_cast<int>(state.range(0));
  o.constraints = 6 * o.keyframes;
  o.mistaken = static_cast<double>(state.range(1)) / 100;
  MapGraph graph;
  fill_graph(test::make_graph_scene(o, 1), &graph);
  const double begin_ms = thread_cpu_ms();
  int steps = 0;
  size_t failed = 0;
  for (auto _ : state) {
    const GraphSolution solution = graph.solve(MapGraph::Sigmas::kEpochs);
    steps += solution.iterations;
    failed = solution.failed.size();
  }
  const double solves = static_cast<double>(state.iterations());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["cpu_s"] = (thread_cpu_ms() - begin_ms) / 1000 / solves;
  state.counters["steps"] = steps / solves;
  state.counters["failed"] = static_cast<double>(failed);
  state.counters["constraints"] = static_cast<double>(graph.constraints().size());
  state.counters["peak_mb"] = static_cast<double>(usage.ru_maxrss) / 1024;
}

BENCHMARK(solve)->Args({1000, 0})->Args({10000, 0})->Args({10000, 2})->Unit(benchmark::kMillisecond);

}  // namespace
