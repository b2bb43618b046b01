// SPDX-License-Identifier: BSD-3-Clause
// A marking along the motion on a road whose cracks have their depth, and a rail in front of it.
#include "plane_depths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "edge_planes.h"
#include "edgevo/core/random.h"

namespace edgevo {
namespace {

constexpr int kWidth = 640, kHeight = 240;
constexpr double kHorizon = 20, kSlope = 0.002;  // of the road: inverse depth per row below its horizon

double road(const Eigen::Vector2d& px) { return kSlope * (px.y() - kHorizon); }

EdgePlane find_plane(const std::vector<PlaneSample>& samples) {
  const std::vector<FoundPlane> planes = find_planes(samples);
  return planes.empty() ? EdgePlane({}) : planes.front().plane;
}

PlaneSample sample_at(const Eigen::Vector2d& px, double factor, double share) {
  return {px, factor * road(px), share * road(px), 0.2 * share * road(px)};
}

std::vector<PlaneSample> road_samples(Random* random, int count, double noise_share) {
  std::vector<PlaneSample> samples;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d px(random->uniform(0, kWidth), random->uniform(60, kHeight));
    samples.push_back(sample_at(px, 1 + noise_share * random->uniform(-1.7, 1.7), noise_share));
  }
  return samples;
}

TEST(EdgePlane, IsFoundAmongTwiceAsManyOutliers) {
  Random random(5);
  std::vector<PlaneSample> samples = road_samples(&random, 200, 0.01);
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector2d px(random.uniform(0, kWidth), random.uniform(60, kHeight));
    samples.push_back(sample_at(px, random.uniform(0.3, 3), 0.01));
  }
  const EdgePlane plane = find_plane(samples);
  ASSERT_TRUE(plane.is_valid());
  for (const Eigen::Vector2d& px : {Eigen::Vector2d(100, 100), Eigen::Vector2d(500, 220)}) {
    EXPECT_NEAR(plane.at(px).idepth / road(px), 1, 0.02);
    EXPECT_LT(std::abs(plane.at(px).idepth - road(px)), 3 * plane.at(px).sigma);
  }
}

// A road, and a wall along it with fewer edges.
TEST(EdgePlane, IsNotTheOnlyOne) {
  const auto wall = [](const Eigen::Vector2d& px) { return 0.1 + 0.0005 * px.x(); };
  Random random(5);
  std::vector<PlaneSample> samples = road_samples(&random, 500, 0.01);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d px(random.uniform(kWidth / 2, kWidth), random.uniform(0, kHeight));
    const double idepth = wall(px) * (1 + 0.01 * random.uniform(-1.7, 1.7));
    samples.push_back({px, idepth, 0.01 * idepth, 0.002 * idepth});
  }
  const std::vector<FoundPlane> planes = find_planes(samples);
  ASSERT_GE(planes.size(), 2u);
  const Eigen::Vector2d on_road(100, 200), on_wall(500, 80);
  EXPECT_NEAR(planes[0].plane.at(on_road).idepth / road(on_road), 1, 0.02);
  EXPECT_NEAR(planes[1].plane.at(on_wall).idepth / wall(on_wall), 1, 0.02);
  const std::vector<FoundPlane> again = find_planes(samples, {planes[1].plane, planes[0].plane});
  ASSERT_GE(again.size(), 2u);
  EXPECT_NEAR(again[0].plane.at(on_road).idepth / road(on_road), 1, 0.02);
  EXPECT_NEAR(again[1].plane.at(on_wall).idepth / wall(on_wall), 1, 0.02);
}

TEST(EdgePlane, OfAFewSamplesIsNone) {
  Random random(5);
  EXPECT_FALSE(find_plane(road_samples(&random, 20, 0.01)).is_valid());
  EXPECT_FALSE(find_plane({}).is_valid());
}

TEST(EdgePlane, AnErrorThatAllShareDoesNotAverageOut) {
  Random random(5);
  std::vector<PlaneSample> samples = road_samples(&random, 2000, 0.01);
  for (PlaneSample& s : samples) s.common = 0.02 * s.idepth;
  const Eigen::Vector2d px(320, 150);
  EXPECT_GT(find_plane(samples).at(px).sigma, 0.019 * road(px));
}

// A shore: edges known to 0.5 % lie 6 % off its plane. Their own errors alone would pass a narrow slice of
// it.
TEST(EdgePlane, ARoughSurfaceSaysThatItIsNoPlane) {
  const auto sigma_of = [](double relief) {
    Random random(5);
    std::vector<PlaneSample> samples;
    for (const PlaneSample& s : road_samples(&random, 1000, 0))
      samples.push_back(sample_at(s.px, 1 + relief * random.uniform(-1.7, 1.7), 0.005));
    const Eigen::Vector2d px(320, 150);
    return find_plane(samples).corrected(samples).at(px).sigma / road(px);
  };
  EXPECT_LT(sigma_of(0.005), 0.01);
  EXPECT_GT(sigma_of(0.06), 0.03);
}

// The road as a camera sees it, and after it has driven on, in distances from the road.
TEST(EdgePlane, IsPredictedForACameraThatHasMovedOn) {
  const Pinhole pinhole{320, 320, 320, kHorizon, kWidth, kHeight};
  Random random(5);
  const EdgePlane before = find_plane(road_samples(&random, 400, 0.01));
  const SE3 T_before_now(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.1, 0, 3));
  const EdgePlane now = before.seen_from(pinhole, T_before_now);
  ASSERT_TRUE(now.is_valid());
  const Eigen::Vector2d px(400, 200);  // flat: the motion along it changes nothing
  EXPECT_NEAR(now.at(px).idepth / road(px), 1, 0.01);
  EXPECT_GT(now.at(px).sigma, before.at(px).sigma);
  const SE3 T_nearer(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0.5 * 1 / (320 * kSlope), 0));
  EXPECT_NEAR(before.seen_from(pinhole, T_nearer).at(px).idepth / road(px), 2, 0.02);
}

TEST(EdgePlane, WhatIsPredictedIsKeptAmongFewSamplesOfTheRoad) {
  Random random(5);
  const EdgePlane before = find_plane(road_samples(&random, 400, 0.005));
  std::vector<PlaneSample> samples = road_samples(&random, 60, 0.01);
  const EdgePlane now = before.corrected(samples);
  ASSERT_TRUE(now.is_valid());
  const Eigen::Vector2d px(320, 150);
  EXPECT_NEAR(now.at(px).idepth / road(px), 1, 0.01);
  EXPECT_LE(now.at(px).sigma, 1.5 * before.at(px).sigma);
  EXPECT_FALSE(before.corrected(road_samples(&random, 20, 0.01)).is_valid());
}

// Short cracks all over the road, one long marking along the motion, and a rail above it at another depth.
struct RoadView {
  RoadView() {
    edges.width = kWidth, edges.height = kHeight;
    for (int y = 70; y < kHeight - 10; y += 12)
      for (int x = 10; x < kWidth - 30; x += 40)
        add_chain({float(x), float(y)}, {1, 0}, 16, Certain::kByViews);
    marking = int(chains.size());
    add_chain({300, 75}, {0.5f, 0.866f}, 160, Certain::kNot);
  }

  void add_chain(Eigen::Vector2f begin, Eigen::Vector2f step, int pixels, Certain certain) {
    const int chain = int(edges.chains.size()), first = int(edges.pixels.size());
    FinalChain nodes;
    for (int i = 0; i < pixels; ++i) {
      const Eigen::Vector2f p = begin + float(i) * step;
      edges.pixels.push_back({p.x(), p.y(), -step.y(), step.x(), 10, chain});
      if (i % 3 != 0) continue;
      const double idepth = certain == Certain::kNot ? 0 : road(p.cast<double>());
      FinalNode node;
      node.node = {first + i, idepth, 0.005 * idepth, 6};
      node.certain = certain, node.common = 0.002 * idepth;
      nodes.push_back(node);
    }
    edges.chains.push_back({first, first + pixels});
    chains.push_back(nodes);
  }

  // Views show an edge at any depth: it runs along the motion. `has_own`: and at its own as well.
  int known_on_marking(bool is_shown = true, bool has_own = true) {
    const auto weigh_node = [&](const FinalNode&, double idepth) {
      NodeEvidence e;
      e.hypothesis.idepth = idepth, e.hypothesis.views = 4;
      e.common = idepth;
      return e;
    };
    const auto compare_depths = [&](const FinalNode&, double, double own) {
      return is_shown && !(has_own && own > 0) ? 1.0 : -20.0;
    };
    std::vector<EdgePlane> planes;
    lay_on_planes(edges, {1, 0.03}, weigh_node, compare_depths, &planes, &chains);
    int known = 0;
    for (const FinalNode& s : chains[size_t(marking)]) known += s.is_known();
    return known;
  }

  ImageEdges edges;
  std::vector<FinalChain> chains;
  int marking = 0;
};

TEST(PlaneDepths, AMarkingTakesTheDepthOfTheRoad) {
  RoadView view;
  EXPECT_GT(view.known_on_marking(), 45);  // of 54
  for (const FinalNode& s : view.chains[size_t(view.marking)])
    if (s.is_known()) {
      const double truth = road(view.edges.pixels[size_t(s.node.edge_pixel)].position().cast<double>());
      EXPECT_NEAR(s.node.idepth / truth, 1, 0.01);
      EXPECT_LT(s.node.idepth_sigma, 0.01 * truth);
      EXPECT_TRUE(s.node.is_on_plane);
    }
}

TEST(PlaneDepths, WhatViewsAndPlaneBothSayIsBacked) {
  RoadView view;
  view.known_on_marking();
  int backed = 0, known = 0;
  for (size_t c = 0; int(c) < view.marking; ++c)
    for (const FinalNode& s : view.chains[c]) {
      ++known, backed += s.node.is_backed_by_plane;
      EXPECT_FALSE(s.node.is_on_plane);
    }
  EXPECT_GT(backed, 0.9 * known);
}

TEST(PlaneDepths, WhatViewsDoNotShowThereStaysUnknown) { EXPECT_EQ(RoadView().known_on_marking(false), 0); }

TEST(PlaneDepths, AnEdgeStaysOffThePlaneWhereViewsShowItAtItsOwnDepth) {
  for (const bool has_own : {true, false}) {
    RoadView view;
    for (FinalNode& s : view.chains[size_t(view.marking)]) {
      const double idepth = 2 * road(view.edges.pixels[size_t(s.node.edge_pixel)].position().cast<double>());
      s.node.idepth = idepth, s.node.idepth_sigma = 0.05 * idepth;
    }
    const int known = view.known_on_marking(true, has_own);
    EXPECT_TRUE(has_own ? known == 0 : known > 45) << known << " of 54";
  }
}

TEST(PlaneDepths, AnEdgeWithTheRoadOnOneSideOnlyStaysUnknown) {
  RoadView view;  // cracks on the left of the marking alone
  std::vector<FinalChain> left;
  for (const FinalChain& chain : view.chains) {
    const Eigen::Vector2f p = view.edges.pixels[size_t(chain.front().node.edge_pixel)].position();
    if (&chain == &view.chains[size_t(view.marking)])
      view.marking = int(left.size()), left.push_back(chain);
    else if (p.x() + 16 < 300 + (p.y() - 75) * 0.577f)
      left.push_back(chain);
  }
  view.chains = left;
  EXPECT_LT(view.known_on_marking(), 5);
}

}  // namespace
}  // namespace edgevo
