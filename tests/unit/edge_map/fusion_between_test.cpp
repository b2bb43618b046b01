// SPDX-License-Identifier: BSD-3-Clause
// Lines of what a fast vehicle passes between two keyframes: a rendered motorway, with exact poses.
#include <gtest/gtest.h>

#include <memory>

#include "edgevo/edge_map/edge_mapper.h"
#include "edgevo/map_evaluation/map_figures.h"
#include "edgevo/simulation/correspondence.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {
namespace {

constexpr int kFirst = 30, kEnd = 76, kEvery = 5;  // frames; of these, each fifth is a keyframe: 12.5 m

const SceneRenderer& motorway() {
  static const SceneRenderer renderer(load_scene("motorway", 131));
  return renderer;
}
SE3 pose(int frame) { return motorway().scene().T_scene_cam[size_t(frame)]; }

Keyframe keyframe(int frame, std::shared_ptr<const FramePyramid> pyramid) {
  constexpr size_t kEach = 20;  // edge pixels to a point
  Keyframe k;
  k.id = k.frame_index = frame;
  k.T_cam_world = pose(frame).inverse();
  const ImageEdges& edges = pyramid->finest().edges;
  const std::vector<float> depth = motorway().render_depth(frame);
  for (size_t i = 0; i < edges.pixels.size(); i += kEach) {
    const Eigen::Vector2d px = edges.pixels[i].position().cast<double>();
    const double idepth = edge_idepth({depth.data(), edges.width, edges.height, edges.width}, px);
    if (idepth > 0)
      k.points.push_back({px, edges.pixels[i].normal().cast<double>(), idepth, 0.01 * idepth, int(i), {}, 0});
  }
  k.pyramid = std::move(pyramid);
  return k;
}

// The map of keyframes and the frames between them.
Run mapped() {
  const auto log = std::make_shared<MapLog>();
  MapCursor cursor(log);
  const Pinhole pinhole = motorway().camera().pinhole();
  Map map(pinhole, log);
  EdgeMapper mapper(pinhole, {}, {}, false, log);
  PyramidBuilder builder(motorway().camera(), EdgeParams());
  for (int i = kFirst; i < kEnd; ++i) {
    const int before = i - (i - kFirst) % kEvery;
    const auto pyramid = builder.build(motorway().render(i).image);
    if (i == before)
      map.add(keyframe(i, pyramid));
    else
      mapper.add_view(before, pose(i).inverse() * pose(before), *pyramid);
  }
  while (!map.active().empty()) {
    map.marginalise_oldest({});
    mapper.add(map);
  }
  mapper.close();
  Run run;
  run.pinhole = pinhole;
  for (const auto& event : cursor.read())
    if (const auto* e = std::get_if<LinesFinished>(event.get())) {
      run.keyframes.emplace_back();
      run.keyframes.back().frame_index = e->keyframe_id;
      run.keyframes.back().T_world_cam = pose(e->keyframe_id);
      run.keyframes.back().lines = e->lines;
    }
  return run;
}

TEST(FusionBetween, WhatIsPassedBetweenKeyframesIsMapped) {
  constexpr int kWithin10m = 2;  // of the bands
  const edgevo::Run run = mapped();
  const MapFigures figures = evaluate_map(run, motorway(), {4, 2, 0.05, 47, 63});
  std::cout << "[ figures  ]\n" << to_table(figures) << std::endl;
  EXPECT_GT(figures.bands[kWithin10m].completeness(), 0.4);  // measured 0.69; of keyframes alone 0.10
  EXPECT_GT(figures.bands[kWithin10m].rightness(), 0.8);
  for (const KeyframeRecord& k : run.keyframes)
    for (const EdgeLine& line : k.lines)
      for (const EdgeVertex& v : line.vertices)
        ASSERT_TRUE(v.idepth > 0 && v.idepth_sigma > 0 && run.pinhole.contains(v.px.cast<double>()));
}

}  // namespace
}  // namespace edgevo
