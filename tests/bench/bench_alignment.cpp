// SPDX-License-Identifier: BSD-3-Clause
// Time of tracking one frame against a cloud, at 1241x376. Counter: share of inliers.
#include <benchmark/benchmark.h>

#include "bench/bench_scene.h"
#include "edgevo/alignment/tracker.h"
#include "edgevo/confidence/frame_status.h"

namespace {

using namespace edgevo;

// Frame 2 against frame 0, from a standing start: about 11 px of motion.
void track_frame(benchmark::State& state) {
  const auto cloud = make_reference_cloud(test::pyramid(0), test::points(0, int(state.range(0))), false);
  const auto current = test::pyramid(2);
  TrackResult result;
  const SupportScorer scorer{StatusParams()};
  for (auto _ : state)
    result = track(*current, cloud, motion_hypotheses(SE3(), SE3()), scorer, AlignmentParams());
  state.counters["inlier_share"] = result.evidence.inlier_share;
}

void make_cloud(benchmark::State& state) {
  const auto points = test::points(0, int(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(make_reference_cloud(test::pyramid(0), points, false));
}

BENCHMARK(track_frame)->Arg(1500)->Unit(benchmark::kMillisecond);
BENCHMARK(make_cloud)->Arg(1500)->Unit(benchmark::kMillisecond);

}  // namespace
