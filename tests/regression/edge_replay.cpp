// SPDX-License-Identifier: BSD-3-Clause
#include "edge_replay.h"

#include <ctime>
#include <deque>

#include "edgevo/edge_map/edge_mapper.h"

namespace edgevo::test {
namespace {

constexpr int kWindow = 12;  // keyframes whose brightness is compared

// The points of keyframe `k` with their projections into its neighbours, where brightness is compared.
std::vector<MapPoint> points_of(const Run& run, size_t k) {
  const KeyframeRecord& host = run.keyframes[k];
  std::vector<MapPoint> points;
  for (const EdgePoint& e : host.points) {
    MapPoint p;
    p.px = e.px.cast<double>(), p.normal = e.normal.cast<double>(), p.idepth = double(e.idepth);
    for (int i = std::max(0, int(k) - kWindow); i <= int(k) + kWindow && i < int(run.keyframes.size()); ++i) {
      const KeyframeRecord& other = run.keyframes[size_t(i)];
      if (i == int(k) || other.segment != host.segment) continue;
      const Eigen::Vector3d there =
          other.T_world_cam.inverse() * (host.T_world_cam * point_in_camera(run.pinhole, e));
      if (there.z() <= 0.05) continue;
      Observation o;
      o.keyframe_id = i;
      o.match.px = run.pinhole.project(there), o.match.normal = e.normal.cast<double>();
      if (run.pinhole.contains(o.match.px, 4)) p.observations.push_back(o);
    }
    points.push_back(std::move(p));
  }
  return points;
}

std::deque<Keyframe> keyframes_of(const KeepingSource& source, const Run& run, const EdgeParams& params) {
  PyramidBuilder builder(source.camera(), params);
  builder.set_correction(run.camera.applied);
  std::deque<Keyframe> keyframes;
  for (size_t k = 0; k < run.keyframes.size(); ++k) {
    Keyframe keyframe;
    keyframe.id = int(k);
    keyframe.pyramid = builder.build(source.image(run.keyframes[k].frame_index));
    keyframe.T_cam_world = run.keyframes[k].T_world_cam.inverse();
    keyframe.points = points_of(run, k);
    keyframes.push_back(std::move(keyframe));
  }
  return keyframes;
}

// CPU time of a step, milliseconds.
template <class F>
double cpu_ms_of(const F& step) {
  const std::clock_t begin = std::clock();
  step();
  return 1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC;
}

}  // namespace

std::optional<Frame> KeepingSource::next() {
  std::optional<Frame> frame = source_->next();
  if (frame) images_[frame->index] = frame->image;
  return frame;
}

EdgeReplay replay_edges(const KeepingSource& source, const Run& run, const OdometryParams& params,
                        const BetweenFrames& between) {
  EdgeReplay replay;
  replay.run = run;
  for (KeyframeRecord& k : replay.run.keyframes) k.lines.clear();
  std::deque<Keyframe> waiting = keyframes_of(source, run, params.edges);
  for (const Keyframe& k : waiting) replay.pyramids.push_back(k.pyramid);
  while (!waiting.empty()) {
    const int segment = run.keyframes[size_t(waiting.front().id)].segment;
    const auto is_next = [&] {
      return !waiting.empty() && run.keyframes[size_t(waiting.front().id)].segment == segment;
    };
    const auto log = std::make_shared<MapLog>();
    MapCursor cursor(log);
    Map map(run.pinhole, log);
    EdgeMapper mapper(run.pinhole, params.edge_map, {params.alignment, params.status}, false, log,
                      &replay.trace);
    while (is_next() || !map.active().empty()) {
      for (; is_next() && map.active().size() < size_t(params.mapping.window.keyframes);
           waiting.pop_front()) {
        map.add(std::move(waiting.front()));
        if (between)
          between(map.active().back().id, [&](const SE3& T, std::shared_ptr<const FramePyramid> pyramid) {
            replay.cpu_ms += cpu_ms_of([&] { mapper.add_view(map.active().back().id, T, *pyramid); });
          });
      }
      map.marginalise_oldest({});
      replay.cpu_ms += cpu_ms_of([&] { mapper.add(map); });
      map.evict_matches(mapper.keyframes_needed());
    }
    replay.cpu_ms += cpu_ms_of([&] { mapper.close(); });
    for (const auto& event : cursor.read())
      if (const auto* e = std::get_if<LinesFinished>(event.get()))
        replay.run.keyframes[size_t(e->keyframe_id)].lines = e->lines;
  }
  return replay;
}

}  // namespace edgevo::test
