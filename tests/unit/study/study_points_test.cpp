// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/study/study_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "plane_pair.h"

namespace edgevo {
namespace {

class StudyPoints : public ::testing::Test {
 protected:
  std::vector<StudyPoint> sample(int count, double noise, uint64_t seed = 1) {
    Random random(seed);
    return sample_points(pair.host.pyramid->finest().edges, depth(), count, noise, &random);
  }
  ImageView<float> depth() const {
    return {pair.depth_host.data(), pair.camera().width, pair.camera().height, pair.camera().width};
  }
  test::PlanePair pair;
};

TEST_F(StudyPoints, AreEdgePixelsWithoutRepetition) {
  const auto points = sample(400, 0.1);
  ASSERT_EQ(points.size(), 400u);
  std::set<std::pair<double, double>> edges, seen;
  for (const EdgePixel& e : pair.host.pyramid->finest().edges.pixels)
    edges.insert({double(e.x), double(e.y)});
  for (const StudyPoint& p : points) {
    EXPECT_TRUE(edges.count({p.px.x(), p.px.y()}));
    EXPECT_TRUE(seen.insert({p.px.x(), p.px.y()}).second);
    EXPECT_NEAR(p.idepth_true, pair.scene.idepth(SE3(), p.px), 1e-5);
    EXPECT_DOUBLE_EQ(p.idepth_sigma, 0.1 * p.idepth_true);
  }
}

TEST_F(StudyPoints, NoiseIsNormalWithTheGivenStandardDeviation) {
  const auto points = sample(100000, 0.1);  // all there are
  EXPECT_EQ(points.size(), pair.host.pyramid->finest().edges.pixels.size());
  double sum = 0, square = 0;
  for (const StudyPoint& p : points) {
    const double n = (p.idepth / p.idepth_true - 1) / 0.1;
    sum += n, square += n * n;
  }
  const double count = double(points.size());
  EXPECT_NEAR(sum / count, 0, 4 / std::sqrt(count));
  EXPECT_NEAR(square / count, 1, 8 / std::sqrt(count));
}

TEST_F(StudyPoints, CoverTheImageEvenly) {
  // The left half has its share of edge pixels.
  double left_edges = 0, left_points = 0;
  const auto& edges = pair.host.pyramid->finest().edges.pixels;
  for (const EdgePixel& e : edges) left_edges += e.x < 160;
  for (const StudyPoint& p : sample(1000, 0)) left_points += p.px.x() < 160;
  EXPECT_NEAR(left_points / 1000, left_edges / double(edges.size()), 0.07);
}

TEST_F(StudyPoints, FollowTheSeed) {
  const auto a = sample(50, 0.1, 7), b = sample(50, 0.1, 7), c = sample(50, 0.1, 8);
  EXPECT_EQ(a[10].px, b[10].px);
  EXPECT_EQ(a[10].idepth, b[10].idepth);
  EXPECT_NE(a[10].px, c[10].px);
}

TEST_F(StudyPoints, DepthsStayPositiveAndTheSkyIsSkipped) {
  for (const StudyPoint& p : sample(2000, 0.5)) EXPECT_GE(p.idepth, 0.1 * p.idepth_true);
  std::fill(pair.depth_host.begin(), pair.depth_host.end(), 0.0f);
  EXPECT_TRUE(sample(50, 0.1).empty());
}

TEST(StudyPointsOfNothing, AreNone) {
  const std::vector<float> depth(100, 1.0f);
  Random random(1);
  EXPECT_TRUE(sample_points(ImageEdges(), {depth.data(), 10, 10, 10}, 5, 0.1, &random).empty());
}

}  // namespace
}  // namespace edgevo
