// SPDX-License-Identifier: BSD-3-Clause
// The three patch comparisons: which changes of light they cancel, which patches they distinguish, and where
// they are undefined.
#include "edgevo/association/patch_comparison.h"

#include <gtest/gtest.h>

#include "edgevo/association/associate.h"
#include "support/plane_scene.h"

namespace edgevo {
namespace {

const Eigen::Matrix2d kNoWarp = Eigen::Matrix2d::Identity();

struct Named {
  const char* name;
  const PatchComparison& comparison;
  bool cancels_gain;
};
const Named kAll[] = {{"gradient", gradient_comparison(), true},
                      {"intensity", intensity_comparison(), false},
                      {"census", census_comparison(), true}};

class PatchComparisons : public ::testing::TestWithParam<int> {
 protected:
  const Named& named() const { return kAll[GetParam()]; }
  const PatchComparison& comparison() const { return named().comparison; }
  test::PlaneScene scene;
  std::shared_ptr<const FramePyramid> host = scene.pyramid(SE3());
  const PyramidLevel& level = host->finest();
};

TEST_P(PatchComparisons, AnEqualPatchCostsNothingAndOthersMore) {
  int tested = 0;
  double unrelated = 0;
  const auto& edges = level.edges.pixels;
  for (size_t i = 0; i < edges.size(); i += 50) {
    Patch patch;
    if (!comparison().cut(level, edges[i].position().cast<double>(), kNoWarp, 2, &patch)) continue;
    EXPECT_NEAR(comparison().cost(patch, level, edges[i].x, edges[i].y), 0, 1e-5);
    const EdgePixel& other = edges[(i + edges.size() / 2) % edges.size()];
    const double cost = comparison().cost(patch, level, other.x, other.y);
    EXPECT_GE(cost, 0);
    EXPECT_LE(cost, kWorstPatchCost);
    unrelated += cost;
    ++tested;
  }
  ASSERT_GT(tested, 20);
  EXPECT_GT(unrelated / tested, 0.2) << "edges of this smooth texture resemble each other";
}

TEST_P(PatchComparisons, GainAndOffset) {
  const auto relit = scene.pyramid(SE3(), 0.6, 30);
  double sum = 0;
  int tested = 0;
  for (size_t i = 0; i < level.edges.pixels.size(); i += 50) {
    const EdgePixel& e = level.edges.pixels[i];
    Patch patch;
    if (!comparison().cut(level, e.position().cast<double>(), kNoWarp, 2, &patch)) continue;
    sum += comparison().cost(patch, relit->finest(), e.x, e.y);
    ++tested;
  }
  ASSERT_GT(tested, 20);
  if (named().cancels_gain)
    EXPECT_LT(sum / tested, 0.05);
  else
    EXPECT_GT(sum / tested, 0.15);
}

TEST_P(PatchComparisons, APatchAtTheBorderIsRejected) {
  Patch patch;
  EXPECT_FALSE(comparison().cut(level, {1, 100}, kNoWarp, 2, &patch));
  ASSERT_TRUE(comparison().cut(level,
                               level.edges.pixels[level.edges.pixels.size() / 2].position().cast<double>(),
                               kNoWarp, 2, &patch));
  EXPECT_EQ(comparison().cost(patch, level, 1, 100), kWorstPatchCost);
  EXPECT_EQ(comparison().cost(patch, level, 318.5, 100), kWorstPatchCost);
}

TEST_P(PatchComparisons, FindsPointsAlongTheEdge) {
  Vector6d xi;
  xi << 0.1, 0.02, 0.05, 0.004, -0.006, 0.003;
  const SE3 T_world_target = SE3::exp(xi);
  const auto target = scene.pyramid(T_world_target);
  const SE3 T_target_host = T_world_target.inverse();
  const Pinhole& camera = level.pinhole;
  AssociationParams params;
  int photometric = 0, right = 0;
  for (size_t i = 0; i < level.edges.pixels.size(); i += 13) {
    const EdgePixel& e = level.edges.pixels[i];
    const Eigen::Vector2d px = e.position().cast<double>();
    const double idepth = scene.idepth(SE3(), px);
    const AssociationQuery query{host.get(),
                                 target.get(),
                                 px,
                                 e.normal().cast<double>(),
                                 1.02 * idepth,
                                 0.03 * idepth,
                                 T_target_host,
                                 1e-6 * Matrix6d::Identity()};
    const Match m = associate(query, params, comparison());
    if (m.kind != MatchKind::kPhotometric) continue;
    ++photometric;
    right += (m.px - camera.project(T_target_host * (camera.ray(px) / idepth))).norm() < 1;
  }
  ASSERT_GT(photometric, 50);
  EXPECT_GT(right, 0.8 * photometric);
}

std::string name_of(const ::testing::TestParamInfo<int>& info) { return kAll[info.param].name; }
INSTANTIATE_TEST_SUITE_P(All, PatchComparisons, ::testing::Values(0, 1, 2), name_of);

TEST(PatchComparison, CensusCountsSigns) {
  // Two patches of nine pixels, two of which disagree.
  const GrayImage image = test::make_image(20, 20, [](double x, double y) { return 10 * x + y; });
  PyramidLevel level;
  level.gray = Plane<uint8_t>(20, 20);
  std::copy(image.pixels.begin(), image.pixels.end(), level.gray.row(0));
  Patch patch;
  ASSERT_TRUE(census_comparison().cut(level, {10, 10}, kNoWarp, 1, &patch));
  EXPECT_EQ(patch.value[2], 1);   // right
  EXPECT_EQ(patch.value[3], -1);  // left
  patch.value[0] = 1, patch.value[2] = -1;
  EXPECT_NEAR(census_comparison().cost(patch, level, 10, 10), 2.0 * 2 / 8, 1e-6);
}

TEST(PatchComparison, TheOdometryUsesGradient) {
  const test::PlaneScene scene;
  const auto host = scene.pyramid(SE3());
  const EdgePixel& e = host->finest().edges.pixels[500];
  const Eigen::Vector2d px = e.position().cast<double>();
  const AssociationQuery query{host.get(), host.get(), px,    e.normal().cast<double>(),
                               0.2,        0.01,       SE3(), 1e-6 * Matrix6d::Identity()};
  const Match a = associate(query, {}), b = associate(query, {}, gradient_comparison());
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.px, b.px);
}

}  // namespace
}  // namespace edgevo
