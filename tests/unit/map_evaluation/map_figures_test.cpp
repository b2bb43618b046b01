// SPDX-License-Identifier: BSD-3-Clause
// Maps whose figures are known: made of the true edges of the rendered street.
#include "edgevo/map_evaluation/map_figures.h"
#include "edgevo/core/depth_source.h"

#include <gtest/gtest.h>

#include "edgevo/core/error.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/simulation/correspondence.h"

namespace edgevo {
namespace {

constexpr int kEvery = 8, kKeyframes = 4;
constexpr double kUnit = 2.5;  // metres per unit of the made map

const SceneRenderer& street() {
  static const SceneRenderer renderer(load_scene("street", 7));
  return renderer;
}

MapEvaluationOptions options() { return {kEvery, 2, 0.05, 0, kEvery * kKeyframes}; }

// Lines at the true depths times `factor`, of every `every`-th edge.
edgevo::Run true_map(double factor, int every) {
  edgevo::Run run;
  PyramidBuilder builder(street().camera(), EdgeParams());
  run.pinhole = builder.pinhole();
  for (int k = 0; k < kKeyframes; ++k) {
    const RenderedFrame frame = street().render(k * kEvery);
    const ImageView<float> depth{frame.depth.data(), run.pinhole.width, run.pinhole.height,
                                 run.pinhole.width};
    KeyframeRecord keyframe;
    keyframe.frame_index = k * kEvery;
    keyframe.T_world_cam = SE3(frame.T_world_cam.R(), frame.T_world_cam.translation() / kUnit);
    const auto pyramid = builder.build(frame.image);
    const ImageEdges& edges = pyramid->finest().edges;
    for (size_t c = 0; c < edges.chains.size(); c += size_t(every)) {
      EdgeLine line;
      const auto flush = [&] {
        if (line.vertices.size() >= 2) keyframe.lines.push_back(line);
        line.vertices.clear();
      };
      for (int i = edges.chains[c].begin; i < edges.chains[c].end; ++i) {
        const EdgePixel& e = edges.pixels[size_t(i)];
        const float idepth = float(edge_idepth(depth, e.position().cast<double>()) * kUnit / factor);
        const bool jumps =
            !line.vertices.empty() && std::abs(line.vertices.back().idepth - idepth) > 0.05 * idepth;
        if (jumps || !(idepth > 0)) flush();
        if (idepth > 0) line.vertices.push_back({e.position(), idepth, 0.01f, 0, 255});
      }
      flush();
    }
    run.keyframes.push_back(std::move(keyframe));
  }
  return run;
}

TEST(MapFigures, TheTrueMapIsCompleteAndRight) {
  const MapFigures figures = evaluate_map(true_map(1, 1), street(), options());
  EXPECT_NEAR(figures.metres_per_unit, kUnit, 1e-3);
  EXPECT_EQ(figures.frames, kKeyframes);
  EXPECT_GT(figures.bands.back().completeness(), 0.98);
  EXPECT_GT(figures.bands.back().rightness(), 0.9);
}

TEST(MapFigures, WrongDepthsExplainNothing) {
  const MapFigures figures = evaluate_map(true_map(1.2, 1), street(), options());
  EXPECT_LT(figures.bands.back().completeness(), 0.15);
  EXPECT_LT(figures.bands.back().rightness(), 0.25);
}

TEST(MapFigures, HalfOfTheEdgesAreHalfComplete) {
  edgevo::Run half = true_map(1, 2);
  half.keyframes.resize(3);
  MapEvaluationOptions first = options();
  first.end = kEvery * 3;
  const MapFigures figures = evaluate_map(half, street(), first);
  EXPECT_GT(figures.bands.back().completeness(), 0.35);
  EXPECT_LT(figures.bands.back().completeness(), 0.8);
  EXPECT_GT(figures.bands.back().rightness(), 0.9);
}

TEST(MapFigures, BandsAreCumulativeAndKindsAddUp) {
  const MapFigures figures = evaluate_map(true_map(1, 1), street(), options());
  for (size_t i = 1; i < figures.bands.size(); ++i)
    EXPECT_GE(figures.bands[i].edges, figures.bands[i - 1].edges);
  int64_t by_kind = 0, by_direction = 0;
  for (size_t i = 0; i < figures.kinds.size(); ++i)
    (i < 4 ? by_kind : by_direction) += figures.kinds[i].edges;
  EXPECT_EQ(by_kind, by_direction);
  EXPECT_GT(figures.kinds[4].edges, 0);  // along the motion
}

TEST(MapFigures, EdgesAndLinesAreCountedByPlace) {
  edgevo::Run map = true_map(1, 1);
  for (KeyframeRecord& k : map.keyframes)
    for (EdgeLine& line : k.lines) {
      const EdgeVertex& v = line.vertices[line.vertices.size() / 2];
      const SE3 T_scene_cam = street().scene().T_scene_cam[size_t(k.frame_index)];
      if ((T_scene_cam * (kUnit * point_in_camera(map.pinhole, v))).z() < 0.3) line.vertices.clear();
    }
  const MapFigures figures = evaluate_map(map, street(), options());
  int64_t edges = 0;
  for (const MapFigure& m : figures.places) edges += m.edges;
  EXPECT_EQ(edges, figures.kinds[4].edges + figures.kinds[5].edges);
  const MapFigure &ground = figures.places.at(0), &upright = figures.places.at(1);
  EXPECT_GT(ground.edges, 1000);
  EXPECT_LT(ground.completeness(), 0.3);  // these lines were taken out
  EXPECT_GT(upright.edges, 1000);
  EXPECT_GT(upright.completeness(), 0.9);
  EXPECT_GT(upright.rightness(), 0.9);
  EXPECT_NE(to_table(figures).find("on the ground"), std::string::npos);
  EXPECT_NE(to_json(figures).find("\"places\""), std::string::npos);
}

TEST(MapFigures, LinesAreCountedBySource) {
  edgevo::Run map = true_map(1, 4);
  for (KeyframeRecord& k : map.keyframes)
    for (size_t l = 0; l < k.lines.size(); l += 2) {
      k.lines[l].source = DepthSource::kPlane;
      for (EdgeVertex& v : k.lines[l].vertices) v.idepth /= 1.2f;
    }
  const MapFigures figures = evaluate_map(map, street(), options());
  const MapFigure &views = figures.sources.at(0), &plane = figures.sources.at(1);
  EXPECT_EQ(views.drawn + plane.drawn, figures.bands.back().drawn);
  EXPECT_GT(views.rightness(), 0.9);
  EXPECT_LT(plane.rightness(), 0.25);
  EXPECT_NE(to_json(figures).find("\"name\": \"plane\", \"lines\""), std::string::npos);
}

MapFigures figures_with_causes(const edgevo::Run& map) {
  MapEvaluationOptions why = options();
  why.why = true;
  return evaluate_map(map, street(), why);
}

const MissingFigure& of_cause(const MapFigures& f, MissingCause cause) { return f.causes.at(size_t(cause)); }

TEST(MapFigures, EdgesAreCountedByClass) {
  const MapFigures figures = evaluate_map(true_map(1, 1), street(), options());
  int64_t edges = 0;
  for (const MapFigure& m : figures.classes) edges += m.edges;
  EXPECT_EQ(edges, figures.kinds[4].edges + figures.kinds[5].edges);
  for (const Thing t : {Thing::kMarking, Thing::kKerb, Thing::kPole, Thing::kBuilding}) {
    EXPECT_GT(figures.classes[size_t(t)].edges, 100) << to_string(t);
    EXPECT_GT(figures.classes[size_t(t)].completeness(), 0.95) << to_string(t);
  }
  EXPECT_NE(to_table(figures).find("kerbs"), std::string::npos);
  EXPECT_NE(to_json(figures).find("\"classes\""), std::string::npos);
  EXPECT_TRUE(figures.causes.empty());  // unless requested
}

TEST(MapFigures, CausesAddUpToWhatIsMissing) {
  const MapFigures figures = figures_with_causes(true_map(1, 3));
  int64_t missing = 0, causes = 0, along = 0;
  for (const MapFigure& m : figures.classes) missing += m.edges - m.found;
  for (const MissingFigure& m : figures.causes) causes += m.all();
  EXPECT_EQ(causes, missing);
  EXPECT_GT(of_cause(figures, MissingCause::kNoLine).all(), missing / 3);
  EXPECT_GT(of_cause(figures, MissingCause::kAlongMotion).all(), 0);
  for (const MapFigure& m : figures.kinds)
    if (m.name == "along the motion") along = m.edges - m.found;
  EXPECT_LT(of_cause(figures, MissingCause::kAlongMotion).all(), along);
  EXPECT_NE(to_table(figures).find("along the motion"), std::string::npos);
  EXPECT_NE(to_json(figures).find("\"by_class\""), std::string::npos);
}

TEST(MapFigures, AWrongDepthIsNamed) {
  const MapFigures figures = figures_with_causes(true_map(1.2, 1));
  int64_t missing = 0;
  for (const MissingFigure& m : figures.causes) missing += m.all();
  EXPECT_GT(of_cause(figures, MissingCause::kWrongDepth).all(), missing / 2);
}

TEST(MapFigures, WhatOneFrameSeesIsSeenInFewFrames) {
  MapEvaluationOptions one = options();
  one.end = 3, one.why = true;
  const MapFigures figures = evaluate_map(true_map(1, 10000), street(), one);
  int64_t missing = 0;
  for (const MissingFigure& m : figures.causes) missing += m.all();
  EXPECT_GT(missing, 1000);
  EXPECT_EQ(of_cause(figures, MissingCause::kFewFrames).all(), missing);
}

TEST(MapFigures, AMapOfAnotherSceneIsRefused) {
  edgevo::Run still = true_map(1, 50);
  for (KeyframeRecord& k : still.keyframes) k.T_world_cam = SE3();
  EXPECT_THROW(evaluate_map(still, street(), options()), InputError);
}

TEST(MapFigures, ThePictureIsAPng) {
  const std::string png = map_picture_png(true_map(1, 1), street(), 8, options());
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_THROW(map_picture_png(true_map(1, 50), street(), 100000), InputError);
}

}  // namespace
}  // namespace edgevo
