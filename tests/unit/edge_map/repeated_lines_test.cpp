// SPDX-License-Identifier: BSD-3-Clause
// One edge that two keyframes have, far apart in time.
#include "edgevo/edge_map/repeated_lines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace edgevo {
namespace {

constexpr size_t kLong = 20;  // keyframes later
const Pinhole kPinhole{500, 500, 320, 240, 640, 480};

// A horizontal edge, as long as `width` pixels, at a depth.
EdgeLine edge(float first_x, int width, float depth, float relative_sigma = 0.01f) {
  EdgeLine line;
  line.keyframes = 3, line.views = 5;
  for (int i = 0; i < width; ++i)
    line.vertices.push_back({{first_x + float(i), 200}, 1 / depth, relative_sigma / depth, 50, 100});
  return line;
}

// Keyframes in one place, of which the first and the last have a line.
std::vector<KeyframeRecord> keyframes(const EdgeLine& first, const EdgeLine& last, size_t later = kLong) {
  std::vector<KeyframeRecord> all(later + 1);
  all.front().lines = {first}, all.back().lines = {last};
  return all;
}

TEST(RepeatedLines, OneEdgeOfTwoPassesBecomesOneLine) {
  std::vector<KeyframeRecord> all = keyframes(edge(100, 60, 4), edge(100, 60, 4.04f));
  merge_repeated_lines(kPinhole, {}, &all);
  EXPECT_TRUE(all.back().lines.empty());
  ASSERT_EQ(all.front().lines.size(), 1u);
  const EdgeLine& line = all.front().lines[0];
  EXPECT_EQ(line.vertices.size(), 60u);
  EXPECT_EQ(line.keyframes, 6);
  EXPECT_EQ(line.views, 11);                              // of both, and the image of the second host
  EXPECT_NEAR(1 / line.vertices[30].idepth, 4.02, 1e-3);  // alike certain
}

TEST(RepeatedLines, TheMoreCertainDepthCountsMore) {
  std::vector<KeyframeRecord> all = keyframes(edge(100, 60, 4, 0.02f), edge(100, 60, 4.1f, 0.002f));
  merge_repeated_lines(kPinhole, {}, &all);
  ASSERT_EQ(all.front().lines.size(), 1u);
  const EdgeVertex& v = all.front().lines[0].vertices[30];
  EXPECT_NEAR(1 / v.idepth, 4.1, 0.003);
  EXPECT_NEAR(v.idepth_sigma * 4.1, 0.002, 1e-4);
}

TEST(RepeatedLines, WhatOnlyOnePassHasStays) {
  std::vector<KeyframeRecord> all = keyframes(edge(100, 60, 4), edge(130, 60, 4));
  merge_repeated_lines(kPinhole, {}, &all);
  EXPECT_EQ(all.front().lines[0].vertices.size(), 60u);
  ASSERT_EQ(all.back().lines.size(), 1u);
  EXPECT_NEAR(all.back().lines[0].vertices.front().px.x(), 161, 1);
  EXPECT_EQ(all.back().lines[0].keyframes, 3);
}

TEST(RepeatedLines, OthersStayApart) {
  const EdgeLine line = edge(100, 60, 4);
  EdgeLine across;
  for (int i = 0; i < 60; ++i) across.vertices.push_back({{120, 170 + float(i)}, 0.25f, 0.0025f, 50, 100});
  for (const EdgeLine& other : {edge(100, 60, 5), across}) {
    std::vector<KeyframeRecord> all = keyframes(line, other);
    merge_repeated_lines(kPinhole, {}, &all);
    EXPECT_EQ(all.back().lines.size(), 1u);
    EXPECT_EQ(all.back().lines[0].vertices.size(), 60u);
  }
  std::vector<KeyframeRecord> elsewhere = keyframes(line, line);
  elsewhere.back().T_world_cam = SE3(Eigen::Quaterniond::Identity(), {0, 0.1, 0});
  merge_repeated_lines(kPinhole, {}, &elsewhere);
  EXPECT_EQ(elsewhere.back().lines.size(), 1u);
  std::vector<KeyframeRecord> other_segment = keyframes(line, line);
  other_segment.back().segment = 1;
  merge_repeated_lines(kPinhole, {}, &other_segment);
  EXPECT_EQ(other_segment.back().lines.size(), 1u);
}

// They have shared their lines as they came.
TEST(RepeatedLines, KeyframesInTheWindowAreLeft) {
  std::vector<KeyframeRecord> all = keyframes(edge(100, 60, 4), edge(100, 60, 4), 12);
  merge_repeated_lines(kPinhole, {}, &all);
  EXPECT_EQ(all.back().lines.size(), 1u);
}

TEST(RepeatedLines, TheLinesOfATurnedCameraAreFound) {
  std::vector<KeyframeRecord> all = keyframes(edge(300, 60, 4), {});
  const SE3 T_world_cam(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY())),
                        {0.3, 0.1, 0.2});
  all.back().T_world_cam = T_world_cam;
  all.back().lines = {edge(300, 60, 4)};
  for (EdgeVertex& v : all.back().lines[0].vertices) {
    const Eigen::Vector3d p = T_world_cam.inverse() * point_in_camera(kPinhole, v);
    v.px = kPinhole.project(p).cast<float>(), v.idepth = float(1 / p.z());
  }
  merge_repeated_lines(kPinhole, {}, &all);
  EXPECT_TRUE(all.back().lines.empty());
}

}  // namespace
}  // namespace edgevo
