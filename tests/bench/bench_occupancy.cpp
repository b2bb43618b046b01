// SPDX-License-Identifier: BSD-3-Clause
// Time of the octree: rays inserted per second, and the time of a keyframe at the end of a long run compared
// with that at its start.
#include <benchmark/benchmark.h>

#include <random>

#include "edgevo/occupancy/octree_map.h"

namespace {

using namespace edgevo;

// A vehicle moving half a metre per keyframe between two house fronts, 8 m to each side: points on them and
// on the ground, 2 to 25 m away.
Run long_drive(int keyframes, int points) {
  Run run;
  run.pinhole = {700, 700, 620, 188, 1241, 376};
  std::mt19937 random(1);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  for (int k = 0; k < keyframes; ++k) {
    KeyframeRecord keyframe;
    keyframe.frame_index = k;
    keyframe.T_world_cam = SE3(Eigen::Quaterniond::Identity(), {0, 0, 0.5 * k});
    while (int(keyframe.points.size()) < points) {
      const int place = std::uniform_int_distribution<int>(0, 2)(random);
      const double z = uniform(3, 25);
      const Eigen::Vector3d p = place == 0 ? Eigen::Vector3d(uniform(-8, 8), 1.65, z)
                                           : Eigen::Vector3d(place == 1 ? -8 : 8, uniform(-4, 1.6), z);
      const Eigen::Vector2d px = run.pinhole.project(p);
      if (!run.pinhole.contains(px)) continue;
      EdgePoint e;
      e.px = px.cast<float>();
      e.normal = {1, 0};
      e.idepth = float(1 / z), e.idepth_sigma = float(0.02 / z);
      e.observations = 4;
      keyframe.points.push_back(e);
    }
    run.keyframes.push_back(std::move(keyframe));
  }
  return run;
}

OccupancyParams metres(double resolution) {
  OccupancyParams params;
  params.resolution = std::to_string(resolution);
  params.max_range = "20";
  return params;
}

// Range: resolution in centimetres. Counter: carving rays per second, including marking and the final
// pruning.
void insert_rays(benchmark::State& state) {
  const Run run = long_drive(40, 2000);
  int64_t rays = 0;
  for (auto _ : state) rays += OctreeMap(run, metres(double(state.range(0)) / 100)).stats().rays;
  state.counters["rays/s"] = benchmark::Counter(double(rays), benchmark::Counter::kIsRate);
}
BENCHMARK(insert_rays)->Arg(20)->Arg(10)->Unit(benchmark::kMillisecond);

// A run of 2000 keyframes. Counters: milliseconds per keyframe over its first and its last 200 (beginning
// with the 200th, when the first voxels are there), as recorded by the builder.
void long_run(benchmark::State& state) {
  const Run run = long_drive(2000, 300);
  double early = 0, late = 0;
  for (auto _ : state) {
    const std::vector<double> ms = OctreeMap(run, metres(0.2)).stats().batch_ms;
    for (size_t i = 0; i < 200; ++i) early += ms[200 + i] / 200, late += ms[ms.size() - 1 - i] / 200;
  }
  state.counters["early_ms"] = early / double(state.iterations());
  state.counters["late_ms"] = late / double(state.iterations());
}
BENCHMARK(long_run)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
