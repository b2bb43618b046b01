// SPDX-License-Identifier: BSD-3-Clause
// Input that cannot be solved, or only in part: reported by a value, by an InputError if malformed, never by
// a NaN.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "edgevo/core/error.h"
#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

using namespace test;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

BaProblem noisy() {
  SceneOptions o;
  o.points = 80;
  o.noise_px = 0.5;
  return perturb(make_scene(o), 0.02, 0.005, 0.05, 3);
}

class BundleAdjustmentDegenerate : public ::testing::TestWithParam<std::string> {
 protected:
  BaResult solve(BaProblem* p, const BaOptions& options = {}) {
    return make_bundle_adjuster(GetParam())->solve(p, options);
  }

  void expect_untouched(BaProblem p) {
    const BaProblem before = p;
    const BaResult result = solve(&p);
    EXPECT_FALSE(result.usable);
    EXPECT_EQ(result.idepth_sigma.size(), p.points.size());
    EXPECT_EQ(result.residual_normal_px.size(), p.observations.size());
    for (const double r : result.residual_normal_px) EXPECT_TRUE(std::isfinite(r));
    for (const double r : result.residual_tangent_px) EXPECT_TRUE(std::isfinite(r));
    for (std::size_t i = 0; i < p.poses.size(); ++i) {
      if (!before.poses[i].T_cam_world.is_finite()) continue;
      EXPECT_EQ(p.poses[i].T_cam_world.matrix(), before.poses[i].T_cam_world.matrix());
    }
    for (std::size_t i = 0; i < p.points.size(); ++i) {
      if (!std::isfinite(before.points[i].idepth)) continue;
      EXPECT_EQ(p.points[i].idepth, before.points[i].idepth);
    }
  }

  void expect_finite(const BaProblem& p) {
    for (const BaPose& pose : p.poses) EXPECT_TRUE(pose.T_cam_world.is_finite());
    for (const BaPoint& x : p.points) EXPECT_TRUE(std::isfinite(x.idepth));
  }
};
INSTANTIATE_TEST_SUITE_P(Both, BundleAdjustmentDegenerate, ::testing::Values("schur", "ceres"),
                         [](const auto& info) { return info.param; });

TEST_P(BundleAdjustmentDegenerate, NothingToSolveIsNotUsable) {
  expect_untouched(BaProblem());
  BaProblem p = noisy();
  p.observations.clear();
  expect_untouched(p);
}

TEST_P(BundleAdjustmentDegenerate, EverythingFixedIsNotUsableButHasResiduals) {
  BaProblem p = noisy();
  for (BaPose& pose : p.poses) pose.fixed = true;
  for (BaPoint& x : p.points) x.fixed = true;
  expect_untouched(p);
  EXPECT_NE(solve(&p).residual_normal_px[0], 0);
}

TEST_P(BundleAdjustmentDegenerate, NonFiniteInputIsNotUsable) {
  const BaProblem good = noisy();
  BaProblem p = good;
  p.observations[5].px.x() = kNaN;
  expect_untouched(p);
  p = good;
  p.points[3].idepth = kNaN;
  expect_untouched(p);
  p = good;
  p.points[3].ray.y() = std::numeric_limits<double>::infinity();
  expect_untouched(p);
  p = good;
  p.poses[4].T_cam_world = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, kNaN, 0));
  expect_untouched(p);
  p = good;
  p.prior = BaPrior{{104}, {SE3()}, Eigen::MatrixXd::Constant(6, 6, kNaN), Eigen::VectorXd::Zero(6), 0};
  expect_untouched(p);
}

TEST_P(BundleAdjustmentDegenerate, AllPosesFixedMovesDepthsOnly) {
  BaProblem p = noisy();
  for (BaPose& pose : p.poses) pose.fixed = true;
  const BaProblem before = p;
  const BaResult result = solve(&p);
  ASSERT_TRUE(result.usable);
  EXPECT_LT(result.final_cost, result.initial_cost);
  EXPECT_LT(pose_difference(p, before), 1e-14);
  EXPECT_GT(depth_difference(p, before), 1e-4);
}

TEST_P(BundleAdjustmentDegenerate, AllPointsFixedMovesPosesOnly) {
  BaProblem p = noisy();
  for (BaPoint& x : p.points) x.fixed = true;
  const BaProblem before = p;
  ASSERT_TRUE(solve(&p).usable);
  EXPECT_EQ(depth_difference(p, before), 0);
  EXPECT_GT(pose_difference(p, before), 1e-4);
}

TEST_P(BundleAdjustmentDegenerate, UnobservedPointsAndPosesAreUnchanged) {
  BaProblem p = noisy();
  BaPoint lonely = p.points[0];
  p.points.push_back(lonely);
  p.poses.push_back({SE3(), false});
  p.pose_ids.push_back(999);
  const BaResult result = solve(&p);
  ASSERT_TRUE(result.usable);
  EXPECT_LT(result.final_cost, result.initial_cost);
  EXPECT_EQ(p.points.back().idepth, lonely.idepth);
  EXPECT_EQ(result.idepth_sigma.back(), 0);
  EXPECT_TRUE(p.poses.back().T_cam_world.log().isZero(0));
}

TEST_P(BundleAdjustmentDegenerate, PointBehindACameraIsSkipped) {
  BaProblem p = noisy();
  const BaProblem before = p;
  const int hidden = p.observations[0].point;
  // Hosted by the first pose and closer than the step to all others, so that it is behind them.
  p.points[hidden].host = 0;
  p.points[hidden].ray = {0, 0, 1};
  p.points[hidden].idepth = 10;
  std::vector<BaObservation> kept;
  for (const BaObservation& o : p.observations)
    if (o.point != hidden || o.target != 0) kept.push_back(o);
  p.observations = kept;
  const BaResult result = solve(&p, to_the_end());
  ASSERT_TRUE(result.usable);
  expect_finite(p);
  EXPECT_EQ(p.points[hidden].idepth, 10);

  BaProblem rest = before;
  kept.clear();
  for (const BaObservation& o : rest.observations)
    if (o.point != hidden) kept.push_back(o);
  rest.observations = kept;
  solve(&rest, to_the_end());
  EXPECT_LT(pose_difference(p, rest), 1e-7);
  for (std::size_t i = 0; i < p.observations.size(); ++i) {
    EXPECT_EQ(result.observation_valid[i] == 0, p.observations[i].point == hidden);
    if (result.observation_valid[i] == 0) {
      EXPECT_EQ(result.residual_normal_px[i], 0);
    }
  }
}

TEST_P(BundleAdjustmentDegenerate, NoVisiblePointIsNotUsable) {
  BaProblem p = noisy();
  for (BaPose& pose : p.poses) pose.T_cam_world = SE3();
  for (BaPoint& x : p.points) x.ray = -x.ray;
  expect_untouched(p);
}

// Matches so wrong that moving points behind a camera would be cheapest: each such match still has its cost.
TEST_P(BundleAdjustmentDegenerate, HidingAPointHasItsCost) {
  BaProblem p = noisy();
  const Eigen::Vector2d centre = p.pinhole.project({0, 0, 1});
  for (BaObservation& o : p.observations)
    if (o.point % 2 == 0) o.px = centre - 3 * (o.px - centre);
  const BaResult result = solve(&p);
  ASSERT_TRUE(result.usable);
  expect_finite(p);
  EXPECT_LT(result.final_cost, result.initial_cost);
  const double width = BaOptions().huber_width;
  double cost = 0;
  int hidden = 0;
  for (std::size_t i = 0; i < p.observations.size(); ++i) {
    const BaObservation& o = p.observations[i];
    hidden += result.observation_valid[i] == 0;
    const double r = result.observation_valid[i] == 0
                         ? 1000 * o.inv_sigma_normal
                         : std::hypot(o.inv_sigma_normal * result.residual_normal_px[i],
                                      o.inv_sigma_tangent * result.residual_tangent_px[i]);
    cost += r <= width ? 0.5 * r * r : width * (r - 0.5 * width);
  }
  EXPECT_GT(hidden, 0);
  EXPECT_NEAR(cost, result.final_cost, 1e-9 * cost);
}

TEST_P(BundleAdjustmentDegenerate, PureRotationHasNoDepthAndStaysFinite) {
  BaProblem p = noisy();
  Random random(4);
  for (BaPose& pose : p.poses) {
    Vector6d xi = random_tangent(&random, 0, 0.05);
    pose = {SE3::exp(xi), true};
  }
  p.poses.back().fixed = false;
  const BaProblem before = p;
  const BaResult result = solve(&p);
  ASSERT_TRUE(result.usable);
  expect_finite(p);
  for (const double sigma : result.idepth_sigma) EXPECT_TRUE(std::isfinite(sigma));
}

TEST_P(BundleAdjustmentDegenerate, MalformedProblemsThrow) {
  const auto expect_throw = [&](const std::function<void(BaProblem*)>& spoil) {
    BaProblem p = noisy();
    spoil(&p);
    EXPECT_THROW(solve(&p), InputError);
  };
  expect_throw([](BaProblem* p) { p->points[0].host = 7; });
  expect_throw([](BaProblem* p) { p->observations[0].point = -1; });
  expect_throw([](BaProblem* p) { p->observations[0].target = 7; });
  expect_throw([](BaProblem* p) { p->observations[0].target = p->points[p->observations[0].point].host; });
  expect_throw([](BaProblem* p) { std::swap(p->observations.front(), p->observations.back()); });
  expect_throw([](BaProblem* p) { p->pose_ids.pop_back(); });
  const Eigen::Vector3d ahead(0, 0, 1);
  expect_throw([&](BaProblem* p) { p->corners.push_back({0, 7, ahead, ahead, 2}); });
  expect_throw([&](BaProblem* p) { p->corners.push_back({3, 3, ahead, ahead, 2}); });
  const BaPrior stranger{{55}, {SE3()}, Eigen::MatrixXd::Identity(6, 6), Eigen::VectorXd::Zero(6), 0};
  expect_throw([&](BaProblem* p) { p->prior = stranger; });
  const BaPrior short_b{{104}, {SE3()}, Eigen::MatrixXd::Identity(6, 6), Eigen::VectorXd::Zero(5), 0};
  expect_throw([&](BaProblem* p) { p->prior = short_b; });
}

TEST(BundleAdjusterNames, UnknownNameOffersTheNearest) {
  EXPECT_EQ(make_bundle_adjuster("schur")->name(), "schur");
  EXPECT_EQ(make_bundle_adjuster("ceres")->name(), "ceres");
  try {
    make_bundle_adjuster("cers");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean ceres"), std::string::npos);
  }
}

TEST(BundleAdjustmentDegenerateMarginalize, UnknownPoseThrowsAndNaNGivesNoPrior) {
  BaProblem p = noisy();
  std::vector<bool> drop;
  EXPECT_THROW(marginalize(p, 7, BaOptions(), &drop), InputError);
  p.observations[5].px.x() = kNaN;
  EXPECT_TRUE(marginalize(p, 102, BaOptions(), &drop).pose_ids.empty());
}

}  // namespace
}  // namespace edgevo
