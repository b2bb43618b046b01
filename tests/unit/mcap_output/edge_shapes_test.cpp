// SPDX-License-Identifier: BSD-3-Clause
// Points and lines made small: how many, how exact.
#include "edge_shapes.h"

#include <gmock/gmock.h>

namespace edgevo {
namespace {

const ShapeView kView{{100, 100, 50, 50, 101, 101}, Sim3{2, SE3(Eigen::Quaterniond::Identity(), {1, 0, 0})}};

Timestamp second(double s) { return Timestamp::from_seconds(s); }

// Vertices at pixels, 4 units away (8 in the map), known to a per cent.
EdgeLine line_of(const std::vector<Eigen::Vector2f>& pixels, bool is_straight = false) {
  EdgeLine line;
  line.is_straight = is_straight;
  for (const Eigen::Vector2f& px : pixels) line.vertices.push_back({px, 0.25f, 0.0025f, 100, 200});
  return line;
}

// An L of `count` vertices, a pixel apart.
EdgeLine bent(int count) {
  std::vector<Eigen::Vector2f> pixels;
  for (int i = 0; i < count; ++i)
    pixels.emplace_back(i < count / 2 ? i : count / 2, i < count / 2 ? 0 : i - count / 2);
  return line_of(pixels);
}

TEST(Allowance, GrowsWithTime) {
  Allowance allowance(100);
  allowance.advance(second(5));
  EXPECT_EQ(allowance.take(10), 0u);
  allowance.advance(second(6));
  EXPECT_EQ(allowance.take(30), 30u);
  EXPECT_EQ(allowance.take(100), 70u);
  allowance.advance(second(4));  // a clock that was set back
  EXPECT_EQ(allowance.take(1), 0u);
  allowance.advance(second(1000));
  EXPECT_EQ(allowance.take(100000), 400u);
}

TEST(EdgeShapes, StraightLinesAreOnePiece) {
  const auto ends = pieces_of({line_of({{50, 50}, {60, 50}, {70, 51}, {80, 50}}, true)}, kView, 10);
  ASSERT_EQ(ends.size(), 2u);
  const double sigma = 0.0025 / (0.25 * 0.25) * 2;
  EXPECT_LT((ends[0] - Eigen::Vector3d(1, 0, 8)).norm(), sigma);
  EXPECT_LT((ends[1] - Eigen::Vector3d(1 + 2.4, 0, 8)).norm(), sigma);
}

TEST(EdgeShapes, BentLinesKeepTheirCorners) {
  const auto ends = pieces_of({bent(40)}, kView, 10);
  ASSERT_EQ(ends.size(), 4u);
  EXPECT_EQ(ends[1], ends[2]);
}

TEST(EdgeShapes, TheLongestLinesComeFirst) {
  const std::vector<EdgeLine> lines{line_of({{1, 1}, {2, 1}}, true), bent(40)};
  EXPECT_EQ(pieces_of(lines, kView, 1).size(), 2u);
  EXPECT_EQ(pieces_of(lines, kView, 1)[0], pieces_of({bent(40)}, kView, 1)[0]);
  EXPECT_TRUE(pieces_of(lines, kView, 0).empty());
}

TEST(EdgeShapes, SamplesAreAboutAsManyAsAllowed) {
  const std::vector<EdgeLine> lines(10, bent(40));
  EXPECT_EQ(samples_of(lines, kView, 1000).size(), 400u);
  const size_t some = samples_of(lines, kView, 100).size();
  EXPECT_GE(some, 80u);
  EXPECT_LE(some, 120u);
  EXPECT_TRUE(samples_of(lines, kView, 0).empty());
  EXPECT_FLOAT_EQ(samples_of(lines, kView, 100)[0].intensity, 150);
}

TEST(EdgeShapes, CloudsKeepEveryNthGoodPoint) {
  KeyframeRecord keyframe;
  for (int i = 0; i < 100; ++i) {
    EdgePoint p;
    p.px = {float(i), 50}, p.normal = {1, 0};
    p.idepth = 0.5f, p.idepth_sigma = i % 2 == 0 ? 0.01f : 1.f;
    p.observations = 3;
    keyframe.points.push_back(p);
  }
  EXPECT_EQ(points_kept(keyframe, {}), 50u);
  const std::vector<RosPoint> all = cloud_of(keyframe, kView, {}, 50);
  ASSERT_EQ(all.size(), 50u);
  EXPECT_EQ(cloud_of(keyframe, kView, {}, 20).size(), 17u);
  for (size_t i = 0; i < all.size(); ++i) {
    const Eigen::Vector3d want = kView.T_map_cam * Eigen::Vector3d((2.0 * double(i) - 50) / 100 * 2, 0, 2);
    const double sigma = 0.01 / 0.25 * 2;
    EXPECT_LT((all[i].position.cast<double>() - want).cwiseAbs().maxCoeff(), 0.126 * sigma);
    EXPECT_NEAR(all[i].sigma, sigma, 0.126 * sigma);
  }
}

}  // namespace
}  // namespace edgevo
