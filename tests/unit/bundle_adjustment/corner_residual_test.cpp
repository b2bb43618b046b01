// SPDX-License-Identifier: BSD-3-Clause
// Corners in the bundle adjustment: residual and derivatives, observable and unobservable directions, both
// solvers, the prior.
#include "residuals/corner_residual.h"

#include <gmock/gmock.h>

#include "support/bundle_adjustment_scene.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

using namespace test;

SceneOptions with_corners() {
  SceneOptions o;
  o.corners = 40;
  return o;
}

// Two poses with corners; the first is fixed.
BaProblem two_views() {
  SceneOptions o = with_corners();
  o.poses = 2;
  o.points = 0;
  o.fixed_poses = 1;
  return make_scene(o);
}

SE3 motion(const BaProblem& p) { return p.poses[1].T_cam_world * p.poses[0].T_cam_world.inverse(); }

TEST(BundleAdjustmentCorners, ResidualIsTheDistanceFromBothEpipolarLines) {
  const SE3 sideways(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-0.5, 0, 0));
  const Eigen::Vector3d x = pinhole().ray({400, 200}),
                        one_px_off = x + Eigen::Vector3d(-0.05, 1 / pinhole().fx, 0);
  // The epipolar lines are rows: half of the pixel is corrected in either image.
  EXPECT_NEAR(std::abs(ba::linearize(pinhole(), sideways, {0, 1, x, one_px_off, 3}).residual),
              3 / std::sqrt(2.0), 1e-9);
}

TEST(BundleAdjustmentCorners, TheLengthOfTheBaselineDoesNotMatter) {
  const BaProblem p = perturb(two_views(), 0, 0.01, 0, 3);
  const SE3 T = motion(p);
  for (const BaCornerPair& c : p.corners)
    EXPECT_NEAR(ba::linearize(p.pinhole, T, c).residual,
                ba::linearize(p.pinhole, SE3(T.rotation(), 7 * T.translation()), c).residual, 1e-9);
}

// For a corner with zero residual the fixed denominator does not matter: the derivatives are exact.
TEST(BundleAdjustmentCorners, DerivativesAreTheNumericOnes) {
  const BaProblem p = make_scene(with_corners());
  for (const BaCornerPair& c : p.corners) {
    const SE3 &to = p.poses[c.to].T_cam_world, &from = p.poses[c.from].T_cam_world;
    const ba::CornerLinearization lin = ba::linearize(p.pinhole, to * from.inverse(), c);
    EXPECT_NEAR(lin.residual, 0, 1e-9);
    const Vector6d J_from = -(to * from.inverse()).adjoint().transpose() * lin.J_to;
    const auto residual = [&](const SE3& T_to, const SE3& T_from) {
      return ba::linearize(p.pinhole, T_to * T_from.inverse(), c).residual;
    };
    const auto by_to = [&](const Vector6d& d) { return residual(SE3::exp(d) * to, from); };
    const auto by_from = [&](const Vector6d& d) { return residual(to, SE3::exp(d) * from); };
    EXPECT_THAT(lin.J_to.transpose().eval(), JacobianNear(numerical_jacobian<6>(by_to, 1e-6), 1e-3));
    EXPECT_THAT(J_from.transpose().eval(), JacobianNear(numerical_jacobian<6>(by_from, 1e-6), 1e-3));
  }
}

class CornerAdjusters : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Both, CornerAdjusters, ::testing::Values("schur", "ceres"),
                         [](const auto& info) { return info.param; });

TEST_P(CornerAdjusters, CornersAloneGiveRotationAndDirection) {
  const BaProblem truth = two_views();
  BaProblem p = perturb(truth, 0.05, 0.03, 0, 5);
  EXPECT_GT((motion(p) * motion(truth).inverse()).angle(), 0.01);
  ASSERT_TRUE(make_bundle_adjuster(GetParam())->solve(&p, to_the_end()).usable);
  EXPECT_LT((motion(p) * motion(truth).inverse()).angle(), 1e-6);
  EXPECT_LT((motion(p).translation().normalized() - motion(truth).translation().normalized()).norm(), 1e-5);
}

TEST(BundleAdjustmentCorners, SolversTakeTheSameSteps) {
  SceneOptions o = with_corners();
  o.noise_px = 0.5;
  const BaProblem start = perturb(make_scene(o), 0.05, 0.01, 0.2, 9);
  for (const int iterations : {1, 2, 4}) {
    BaOptions options;
    options.max_iterations = iterations;
    options.relative_decrease = 0;
    BaProblem a = start, b = start;
    const BaResult schur = make_bundle_adjuster("schur")->solve(&a, options),
                   ceres = make_bundle_adjuster("ceres")->solve(&b, options);
    EXPECT_NEAR(schur.initial_cost, ceres.initial_cost, 1e-10 * ceres.initial_cost);
    EXPECT_NEAR(schur.final_cost, ceres.final_cost, 1e-9 * ceres.final_cost);
    EXPECT_LT(pose_difference(a, b), 1e-9);
    EXPECT_LT(depth_difference(a, b), 1e-9);
  }
}

// Only the corners of a marginalised keyframe remain: they must constrain the other pose as before.
TEST(BundleAdjustmentCorners, ThePriorKeepsTheirInformation) {
  const BaProblem whole = two_views();
  BaOptions options = to_the_end();
  std::vector<bool> drop;
  const BaPrior prior = marginalize(whole, whole.pose_ids[0], options, &drop);
  ASSERT_EQ(prior.pose_ids, std::vector<int>{whole.pose_ids[1]});
  BaProblem rest;
  rest.pinhole = whole.pinhole;
  rest.poses = {whole.poses[1]};
  rest.pose_ids = {whole.pose_ids[1]};
  rest.prior = prior;
  // No information along the baseline, in every other direction as much as before.
  const Eigen::Vector3d along = motion(whole).translation().normalized();
  Vector6d longer = Vector6d::Zero();
  longer.head<3>() = along;
  const double along_the_way = longer.dot(prior.H * longer), in_all = prior.H.diagonal().head<3>().sum();
  EXPECT_LT(along_the_way, 1e-6 * in_all);
  rest = perturb(rest, 0.005, 0.003, 0, 3);
  ASSERT_TRUE(make_bundle_adjuster("schur")->solve(&rest, options).usable);
  EXPECT_LT((rest.poses[0].T_cam_world * whole.poses[1].T_cam_world.inverse()).angle(), 1e-6);
}

}  // namespace
}  // namespace edgevo
