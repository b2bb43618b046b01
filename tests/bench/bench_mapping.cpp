// SPDX-License-Identifier: BSD-3-Clause
// Time of the mapping of one keyframe, at 1241x376: association alone, one frame of the depth filter, and a
// whole keyframe through the mapper.
#include <benchmark/benchmark.h>

#include "bench/bench_scene.h"
#include "edgevo/alignment/tracker.h"
#include "edgevo/association/associate.h"
#include "edgevo/confidence/frame_status.h"
#include "edgevo/mapping/depth_filter.h"
#include "edgevo/mapping/mapper.h"

namespace {

using namespace edgevo;

// Points of frame 0 matched with frame 4. Counter: share that matched.
void associate_points(benchmark::State& state) {
  const auto points = test::points(0, int(state.range(0)));
  AssociationQuery query;
  query.host = test::pyramid(0).get();
  query.target = test::pyramid(4).get();
  query.T_target_host = test::motion(0, 4);
  query.pose_covariance = 1e-6 * Matrix6d::Identity();
  int matched = 0;
  for (auto _ : state) {
    matched = 0;
    for (const CloudPoint& p : points) {
      query.px_host = p.px.cast<double>();
      query.normal_host = p.normal.cast<double>();
      query.idepth = p.idepth;
      query.idepth_sigma = p.idepth_sigma;
      matched += associate(query, AssociationParams()).kind != MatchKind::kNone;
    }
  }
  state.counters["matched"] = double(matched) / double(points.size());
}

// New points of frame 0 searched in frame 4. Counters: points, share with a depth.
void update_depths_once(benchmark::State& state) {
  Keyframe host;
  host.pyramid = test::pyramid(0);
  const DepthFilterParams params;
  Random random(1);
  const CellGrid grid(test::pinhole().width, test::pinhole().height, params.cell_px);
  const auto range = [&](const Eigen::Vector2d& px) {
    const double idepth = test::scene().idepth(test::sweep_pose(0), px);
    return IdepthRange{0.4 * idepth, 2.5 * idepth};
  };
  host.immature =
      make_immature_points(host, grid, std::vector<bool>(size_t(grid.size()), false), range, params, &random);
  const auto target = test::pyramid(4);
  const SE3 T = test::motion(0, 4);
  const std::vector<ImmaturePoint> fresh = host.immature;
  for (auto _ : state) {
    host.immature = fresh;
    update_depths(*target, T, params, &host);
  }
  int found = 0;
  for (const ImmaturePoint& p : host.immature) found += p.good;
  state.counters["points"] = double(fresh.size());
  state.counters["found"] = double(found) / double(fresh.size());
}

// Every third frame a keyframe through the mapper: depth filter, association, activation, bundle adjustment,
// new points. Counters: milliseconds of CPU time by stage, points and observations of the window; means over
// the keyframes.
void process_keyframe(benchmark::State& state) {
  constexpr int kFramesApart = 3;
  Bootstrap bootstrap(test::pinhole(), BootstrapParams(), 1);
  MapperParams params;
  params.camera.refine = "none";
  params.edge_map.mode = "off";
  Mapper mapper(test::pinhole(), params, {});
  int frame = 0;
  for (bool ready = false; !ready; ++frame) {
    const BootstrapStatus status =
        bootstrap.add(frame, Timestamp::from_seconds(0.1 * frame), test::pyramid(frame));
    ready = status.result && mapper.initialise(*status.result).empty();
  }
  SE3 T_last_ref;
  const auto process = [&](bool make_keyframe, const TrackedFrame& tracked) {
    const MapUpdate update = mapper.process(tracked);
    T_last_ref = make_keyframe ? SE3() : tracked.T_cam_ref;
    return update;
  };
  const auto align = [&](bool make_keyframe) {
    const auto reference = mapper.reference();
    const TrackResult r = track(*test::pyramid(frame), reference->cloud, motion_hypotheses(T_last_ref, SE3()),
                                SupportScorer(StatusParams()), AlignmentParams());
    TrackedFrame tracked;
    tracked.frame_index = frame;
    tracked.time = Timestamp::from_seconds(0.1 * frame);
    tracked.pyramid = test::pyramid(frame);
    tracked.reference_id = reference->keyframe_id;
    tracked.T_cam_ref = r.T_cur_ref;
    tracked.covariance = r.covariance;
    tracked.make_keyframe = make_keyframe;
    return tracked;
  };
  std::map<std::string, double> totals;
  for (auto _ : state) {
    state.PauseTiming();
    for (int i = 1; i < kFramesApart; ++i, ++frame) process(false, align(false));
    const TrackedFrame keyframe = align(true);
    ++frame;
    state.ResumeTiming();
    const MapUpdate update = process(true, keyframe);
    for (const auto& [stage, ms] : update.times) totals[stage + "_ms"] += ms;
    totals["points"] += update.stats.points;
    totals["observations"] += update.stats.observations;
  }
  for (const auto& [name, total] : totals) state.counters[name] = total / double(state.iterations());
}

BENCHMARK(associate_points)->Arg(1500)->Unit(benchmark::kMillisecond);
BENCHMARK(update_depths_once)->Unit(benchmark::kMillisecond);
BENCHMARK(process_keyframe)->Iterations(20)->Unit(benchmark::kMillisecond);

}  // namespace
