// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/view_link.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

const Pinhole kPinhole{500, 500, 320, 240, 640, 480};

// Features in front of two cameras, each with a map that has a unit of its own.
struct TwoViews {
  MatchedPixels matches;
  std::vector<CloudPoint> map_a, map_b;

  // `unit`: length in map b over the same length in map a. Depths are known to `noise`, pixels to 0.3.
  TwoViews(const SE3& T_b_a, double unit, int features = 150, double noise = 0.05) {
    Random random(3);
    while (int(matches.a.size()) < features) {
      const Eigen::Vector2d px(random.uniform(20, 620), random.uniform(20, 460));
      const double depth = random.uniform(5, 25);
      const Eigen::Vector3d in_b = T_b_a * (depth * kPinhole.ray(px));
      if (in_b.z() < 1 || !kPinhole.contains(kPinhole.project(in_b))) continue;
      add(px, depth * (1 + noise * random.normal()), &random, &matches.a, &map_a);
      add(kPinhole.project(in_b), unit * in_b.z() * (1 + noise * random.normal()), &random, &matches.b,
          &map_b);
    }
  }

  std::optional<ViewLink> link() const { return link_views(kPinhole, matches, map_a, map_b); }

 private:
  static void add(const Eigen::Vector2d& px, double depth, Random* random, std::vector<Eigen::Vector2f>* seen,
                  std::vector<CloudPoint>* map) {
    seen->push_back((px + 0.3 * Eigen::Vector2d(random->normal(), random->normal())).cast<float>());
    CloudPoint p;
    p.px = px.cast<float>();
    p.normal = {1, 0};
    p.ray = kPinhole.ray(px);
    p.idepth = 1 / depth;
    p.idepth_sigma = 0.05 / depth;
    p.host_keyframe = 1;
    map->push_back(p);
  }
};

SE3 motion(double turn, const Eigen::Vector3d& t) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY())), t};
}

TEST(ViewLink, BothMapsMeasureTheSameBaseline) {
  for (const double unit : {0.4, 1.0, 2.5}) {
    const SE3 T = motion(0.1, {-0.8, 0.2, -2});
    const auto link = TwoViews(T, unit).link();
    ASSERT_TRUE(link) << unit;
    EXPECT_NEAR(link->scale * unit, 1, 0.05) << "length in a over that in b";
    EXPECT_LT(std::abs(std::log(link->scale * unit)), 3 * link->sigma);
    EXPECT_LT((link->T_b_a.translation() - T.translation()).norm(), 0.15) << "in the unit of a";
    EXPECT_LT(
        (link->T_b_a.rotation().conjugate() * T.rotation()).angularDistance(Eigen::Quaterniond::Identity()),
        0.01);
  }
}

// A camera that comes back to where it was: there is no baseline to measure.
TEST(ViewLink, WithoutABaselineTheDepthsAreCompared) {
  const auto link = TwoViews(motion(0.05, {0.01, 0, 0}), 3).link();
  ASSERT_TRUE(link);
  EXPECT_NEAR(link->scale * 3, 1, 0.05);
}

TEST(ViewLink, HalfOfTheDepthsMayBeWrong) {
  TwoViews views(motion(0, {-1, 0, -1.5}), 2, 300);
  for (size_t i = 0; i < views.map_b.size(); i += 3) views.map_b[i].idepth *= 4;
  const auto link = views.link();
  ASSERT_TRUE(link);
  EXPECT_NEAR(link->scale * 2, 1, 0.15);
}

// The depths of a bent map agree with their neighbours: their spread does not show the error.
TEST(ViewLink, AMapThatIsBentIsNoBetterKnownThanItsHalvesAgree) {
  const SE3 T = motion(0.1, {-0.8, 0.2, -2});
  TwoViews views(T, 1, 300);
  const double straight = views.link().value().sigma;
  EXPECT_LT(straight, 0.05);
  for (CloudPoint& p : views.map_b) p.idepth *= 1 + 0.1 * p.ray.x() / 0.4;
  const auto bent = views.link();
  EXPECT_TRUE(!bent || bent->sigma > 0.07);
  TwoViews far(T, 1, 300);
  for (CloudPoint& p : far.map_b) p.idepth *= p.idepth > 1 / 14.0 ? 0.95 : 1.05;
  EXPECT_GT(far.link().value().sigma, 0.07);
}

TEST(ViewLink, GuessedDepthsHaveNoSay) {
  TwoViews views(motion(0, {-1, 0, -1.5}), 2);
  for (CloudPoint& p : views.map_b) p.host_keyframe = -1;
  EXPECT_FALSE(views.link());
}

TEST(ViewLink, FewMatchesLinkNothing) {
  EXPECT_FALSE(TwoViews(motion(0, {-1, 0, -1.5}), 2, 20).link());
  EXPECT_FALSE(link_views(kPinhole, MatchedPixels(), {}, {}));
}

TEST(ViewLink, ViewsOfDifferentScenesLinkNothing) {
  TwoViews views(motion(0, {-1, 0, -1.5}), 2);
  Random random(5);
  for (Eigen::Vector2f& px : views.matches.b)
    px = {float(random.uniform(0, 639)), float(random.uniform(0, 479))};
  EXPECT_FALSE(views.link());
}

}  // namespace
}  // namespace edgevo
