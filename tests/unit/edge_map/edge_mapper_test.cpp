// SPDX-License-Identifier: BSD-3-Clause
// Lines over many keyframes: each edge is mapped once, corrections of the camera move lines, and a thread
// gives the same result.
#include "edgevo/edge_map/edge_mapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "support/sweep_scene.h"

namespace edgevo {
namespace {

using test::Sweep;

std::deque<Keyframe> keyframes() {
  static const std::deque<Keyframe> made = [] {
    std::deque<Keyframe> k;
    Random random(3);
    for (int i = 0; i < 14; ++i) {
      Keyframe keyframe = test::true_keyframe(i, 4 * i, 0, &random);
      for (const ImmaturePoint& p : keyframe.immature)
        keyframe.points.push_back({p.px, p.normal, p.idepth, 0.01 * p.idepth, p.edge_pixel, {}, 0});
      k.push_back(keyframe);
    }
    return k;
  }();
  return made;
}

std::vector<HostedLines> lines_of(const EdgeMapParams& params, bool own_thread,
                                  const MapRevision* revision = nullptr, EdgeTrace* trace = nullptr) {
  std::deque<Keyframe> window = keyframes();
  EdgeMapper mapper(Sweep::pinhole(), params, own_thread, trace);
  while (!window.empty()) {
    const Keyframe oldest = window.front();
    window.pop_front();
    mapper.add(oldest, window);
  }
  if (revision) mapper.apply(*revision);
  EXPECT_EQ(mapper.skipped(), own_thread ? mapper.skipped() : 0);
  return mapper.close();
}

size_t vertices_in(const std::vector<HostedLines>& hosted) {
  size_t count = 0;
  for (const HostedLines& h : hosted)
    for (const EdgeLine& line : h.lines) count += line.vertices.size();
  return count;
}

TEST(EdgeMapper, MapsEachEdgeOnce) {
  EdgeMapParams full, each;
  full.max_relative_sigma = each.max_relative_sigma = 0.02;
  each.mode = "keyframes";
  const std::vector<HostedLines> fused = lines_of(full, false), apart = lines_of(each, false);
  EXPECT_EQ(fused.size(), keyframes().size());
  EXPECT_EQ(apart.size(), keyframes().size());
  std::cout << "[ figures  ] " << vertices_in(fused) << " vertices fused, " << vertices_in(apart) << " apart"
            << std::endl;
  EXPECT_GT(vertices_in(fused), 1000u);
  EXPECT_LT(vertices_in(fused), vertices_in(apart) / 3);
}

// By keyframe and position in its image.
std::map<std::tuple<int, float, float>, double> idepths_in(const std::vector<HostedLines>& hosted) {
  std::map<std::tuple<int, float, float>, double> idepths;
  for (const HostedLines& h : hosted)
    for (const EdgeLine& line : h.lines)
      for (const EdgeVertex& v : line.vertices)
        idepths[{h.keyframe_id, v.px.x(), v.px.y()}] = double(v.idepth);
  return idepths;
}

TEST(EdgeMapper, AVertexHasTheMeanDepthOfItsKeyframes) {
  EdgeMapParams full, each;
  full.max_relative_sigma = each.max_relative_sigma = 0.02;
  each.mode = "keyframes";
  const auto alone = idepths_in(lines_of(each, false));
  int changed = 0;
  double error = 0, error_alone = 0;
  for (const auto& [at, idepth] : idepths_in(lines_of(full, false))) {
    const auto [id, x, y] = at;
    const double truth = Sweep::idepth(4 * id, {double(x), double(y)});
    if (!(truth > 0) || idepth == alone.at(at)) continue;
    ++changed;
    error += std::min(0.1, std::abs(idepth / truth - 1));  // bounds the share of a wrong match
    error_alone += std::min(0.1, std::abs(alone.at(at) / truth - 1));
  }
  std::cout << "[ figures  ] " << changed << " vertices, mean error " << error / changed << ", before "
            << error_alone / changed << std::endl;
  EXPECT_GT(changed, 500);
  EXPECT_LT(error, error_alone);
}

TEST(EdgeMapper, TheTraceShowsWhichPixelsBecameVertices) {
  EdgeTrace trace;
  const std::vector<HostedLines> lines = lines_of(EdgeMapParams(), false, nullptr, &trace);
  EXPECT_EQ(trace.size(), keyframes().size());
  std::map<EdgeStage, int> counts;
  std::set<std::tuple<int, float, float>> kept;
  for (const auto& [id, pixels] : trace) {
    const ImageEdges& edges = keyframes()[size_t(id)].pyramid->finest().edges;
    ASSERT_EQ(pixels.size(), edges.pixels.size());
    for (size_t i = 0; i < pixels.size(); ++i) {
      ++counts[pixels[i].stage];
      EXPECT_TRUE(pixels[i].stage < EdgeStage::kFound || pixels[i].idepth > 0);
      if (pixels[i].stage == EdgeStage::kKept) kept.insert({id, edges.pixels[i].x, edges.pixels[i].y});
    }
  }
  for (const HostedLines& h : lines)
    for (const EdgeLine& line : h.lines)
      for (const EdgeVertex* end : {&line.vertices.front(), &line.vertices.back()})
        EXPECT_EQ(kept.count({h.keyframe_id, end->px.x(), end->px.y()}), 1u);
  for (const EdgeStage gate :
       {EdgeStage::kFewViews, EdgeStage::kAlongMotion, EdgeStage::kExplained, EdgeStage::kUnconfirmed})
    EXPECT_GT(counts[gate], 0) << to_string(gate);
}

TEST(EdgeMapper, ALineHasAVertexForEachEdgePixel) {
  for (const HostedLines& h : lines_of(EdgeMapParams(), false)) {
    const ImageEdges& edges = keyframes()[size_t(h.keyframe_id)].pyramid->finest().edges;
    std::map<std::pair<float, float>, int> pixel_at;
    for (size_t i = 0; i < edges.pixels.size(); ++i)
      pixel_at[{edges.pixels[i].x, edges.pixels[i].y}] = int(i);
    for (const EdgeLine& line : h.lines)
      for (size_t i = 1; i < line.vertices.size(); ++i) {
        const auto before = pixel_at.find({line.vertices[i - 1].px.x(), line.vertices[i - 1].px.y()});
        const auto here = pixel_at.find({line.vertices[i].px.x(), line.vertices[i].px.y()});
        ASSERT_TRUE(before != pixel_at.end() && here != pixel_at.end());
        EXPECT_EQ(here->second, before->second + 1);
      }
  }
}

TEST(EdgeMapper, LinesLieOnTheTrueSurface) {
  EdgeMapParams params;
  params.max_relative_sigma = 0.02;
  int count = 0, good = 0;
  for (const HostedLines& h : lines_of(params, false))
    for (const EdgeLine& line : h.lines) {
      ASSERT_GE(line.vertices.size(), 2u);
      EXPECT_GE(line.keyframes, 1);
      for (const EdgeVertex& v : line.vertices) {
        EXPECT_LE(v.gray_dark, v.gray_bright + 10);
        good += std::abs(double(v.idepth) / Sweep::idepth(4 * h.keyframe_id, v.px.cast<double>()) - 1) < 0.03;
        ++count;
      }
    }
  EXPECT_GT(good, 0.88 * count);  // measured 0.92
}

TEST(EdgeMapper, OffGivesNothing) {
  EdgeMapParams params;
  params.mode = "off";
  EXPECT_TRUE(lines_of(params, false).empty());
}

// A map that has shrunk to half its size: twice the inverse depths.
TEST(EdgeMapper, ARevisionMovesTheLines) {
  MapRevision revision;
  for (const Keyframe& k : keyframes()) {
    RevisedKeyframe r;
    r.id = k.id;
    r.T_cam_world = k.T_cam_world;
    r.length_ratio = 0.5;
    revision.keyframes.push_back(r);
  }
  const std::vector<HostedLines> before = lines_of({}, false), after = lines_of({}, false, &revision);
  ASSERT_EQ(before.size(), after.size());
  ASSERT_GT(vertices_in(before), 100u);
  for (size_t i = 0; i < before.size(); ++i) {
    ASSERT_EQ(before[i].lines.size(), after[i].lines.size());
    for (size_t l = 0; l < before[i].lines.size(); ++l) {
      const EdgeVertex &a = before[i].lines[l].vertices[0], &b = after[i].lines[l].vertices[0];
      EXPECT_FLOAT_EQ(b.idepth, 2 * a.idepth);
      EXPECT_FLOAT_EQ(b.idepth_sigma, 2 * a.idepth_sigma);
      EXPECT_NEAR((a.px - b.px).norm(), 0, 1e-3);
    }
  }
}

TEST(EdgeMapper, IsDeterministic) {
  const std::vector<HostedLines> a = lines_of({}, false), b = lines_of({}, false);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].lines.size(), b[i].lines.size());
    for (size_t l = 0; l < a[i].lines.size(); ++l)
      for (size_t v = 0; v < a[i].lines[l].vertices.size(); ++v)
        ASSERT_EQ(a[i].lines[l].vertices[v].idepth, b[i].lines[l].vertices[v].idepth);
  }
}

// The lines of the keyframes that the thread does not skip are the same.
TEST(EdgeMapper, AThreadOfItsOwnGivesTheSameLines) {
  const std::vector<HostedLines> hosted = lines_of({}, true);
  EXPECT_GT(vertices_in(hosted), 100u);
  for (size_t i = 1; i < hosted.size(); ++i) EXPECT_LT(hosted[i - 1].keyframe_id, hosted[i].keyframe_id);
}

}  // namespace
}  // namespace edgevo
