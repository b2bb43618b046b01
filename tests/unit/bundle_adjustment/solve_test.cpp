// SPDX-License-Identifier: BSD-3-Clause
// Both solvers on synthetic windows: exact recovery, agreement, fixed variables, reproducible bits.
#include <gtest/gtest.h>

#include <cstring>

#include "residuals/edge_residual.h"
#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

using namespace test;

SceneOptions hard_scene() {
  SceneOptions o;
  o.noise_px = 0.5;
  o.outlier_share = 0.1;
  o.fixed_point_share = 0.2;
  return o;
}

BaProblem solved(BaProblem problem, const std::string& name, const BaOptions& options, BaResult* result) {
  *result = make_bundle_adjuster(name)->solve(&problem, options);
  return problem;
}

class BundleAdjusters : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Both, BundleAdjusters, ::testing::Values("schur", "ceres"),
                         [](const auto& info) { return info.param; });

TEST_P(BundleAdjusters, RecoverTheTruthFromNoiseFreeData) {
  const BaProblem truth = make_scene(SceneOptions());
  BaResult result;
  const BaProblem found = solved(perturb(truth, 0.1, 0.02, 0.3, 5), GetParam(), to_the_end(), &result);
  ASSERT_TRUE(result.usable);
  EXPECT_GT(result.initial_cost, 1e3);
  EXPECT_LT(result.final_cost, 1e-12);
  EXPECT_LT(pose_difference(found, truth), 1e-8);
  EXPECT_LT(depth_difference(found, truth), 1e-9);
}

TEST_P(BundleAdjusters, DefaultOptionsReachTheNoiseLevel) {
  SceneOptions o;
  o.noise_px = 0.3;
  const BaProblem truth = make_scene(o);
  BaResult result;
  const BaProblem found = solved(perturb(truth, 0.03, 0.005, 0.1, 5), GetParam(), BaOptions(), &result);
  ASSERT_TRUE(result.usable);
  EXPECT_LE(result.iterations, BaOptions().max_iterations);
  BaResult best;
  solved(truth, GetParam(), to_the_end(), &best);
  EXPECT_LT(result.final_cost, 1.01 * best.final_cost);
  EXPECT_LT(pose_difference(found, truth), 0.05);
}

TEST_P(BundleAdjusters, FixedPosesAndPointsKeepTheirBits) {
  const BaProblem start = perturb(make_scene(hard_scene()), 0.02, 0.005, 0.1, 5);
  BaResult result;
  const BaProblem found = solved(start, GetParam(), BaOptions(), &result);
  ASSERT_TRUE(result.usable);
  int fixed_points = 0;
  for (std::size_t i = 0; i < start.points.size(); ++i) {
    if (!start.points[i].fixed) continue;
    ++fixed_points;
    EXPECT_EQ(found.points[i].idepth, start.points[i].idepth);
    EXPECT_EQ(result.idepth_sigma[i], 0);
  }
  EXPECT_GT(fixed_points, 30);
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(found.poses[i].T_cam_world.matrix(), start.poses[i].T_cam_world.matrix());
  EXPECT_NE(found.poses[2].T_cam_world.matrix(), start.poses[2].T_cam_world.matrix());
}

TEST_P(BundleAdjusters, CostIsTheSumOfHuberCosts) {
  const BaProblem problem = make_scene(hard_scene());
  const BaOptions options;
  double expected = 0;
  for (const BaObservation& o : problem.observations) {
    const BaPoint& p = problem.points[o.point];
    const double r = ba::linearize(problem.pinhole, problem.poses[o.target].T_cam_world,
                                   problem.poses[p.host].T_cam_world, p, o)
                         .residual.norm();
    expected +=
        r <= options.huber_width ? 0.5 * r * r : options.huber_width * (r - 0.5 * options.huber_width);
  }
  BaResult result;
  solved(problem, GetParam(), options, &result);
  EXPECT_NEAR(result.initial_cost, expected, 1e-9 * expected);
  EXPECT_LT(result.final_cost, result.initial_cost);
}

TEST_P(BundleAdjusters, ReportsResidualsAndSigmasAtTheSolution) {
  BaResult result;
  const BaProblem found = solved(make_scene(hard_scene()), GetParam(), to_the_end(), &result);
  ASSERT_EQ(result.residual_normal_px.size(), found.observations.size());
  std::vector<double> information(found.points.size(), 0);
  for (std::size_t i = 0; i < found.observations.size(); ++i) {
    const BaObservation& o = found.observations[i];
    const BaPoint& p = found.points[o.point];
    const ba::EdgeLinearization lin = ba::linearize(found.pinhole, found.poses[o.target].T_cam_world,
                                                    found.poses[p.host].T_cam_world, p, o);
    ASSERT_EQ(result.observation_valid[i], 1);
    EXPECT_NEAR(result.residual_normal_px[i] * o.inv_sigma_normal, lin.residual[0], 1e-9);
    EXPECT_NEAR(result.residual_tangent_px[i] * o.inv_sigma_tangent, lin.residual[1], 1e-9);
    const double norm = lin.residual.norm(), width = BaOptions().huber_width;
    information[o.point] += (norm <= width ? 1 : width / norm) * lin.J_idepth.squaredNorm();
  }
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    if (found.points[i].fixed || information[i] == 0) continue;
    EXPECT_NEAR(result.idepth_sigma[i] * std::sqrt(information[i]), 1, 1e-9);
  }
}

TEST_P(BundleAdjusters, SameProblemSameBits) {
  const BaProblem start = perturb(make_scene(hard_scene()), 0.02, 0.005, 0.1, 5);
  BaResult first, second;
  const BaProblem a = solved(start, GetParam(), BaOptions(), &first);
  const BaProblem b = solved(start, GetParam(), BaOptions(), &second);
  EXPECT_EQ(first.final_cost, second.final_cost);
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    EXPECT_EQ(a.poses[i].T_cam_world.matrix(), b.poses[i].T_cam_world.matrix());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i].idepth, b.points[i].idepth);
}

TEST_P(BundleAdjusters, DepthNeverFallsBelowItsFloor) {
  SceneOptions o;
  o.points = 60;
  BaProblem problem = make_scene(o);
  // Matches of the point mirrored at infinity: the unconstrained minimum has a negative inverse depth.
  for (BaObservation& m : problem.observations) {
    if (m.point >= 10) continue;
    BaPoint x = problem.points[m.point];
    x.idepth = -0.05;
    const SE3 T = problem.poses[m.target].T_cam_world * problem.poses[x.host].T_cam_world.inverse();
    m.px = problem.pinhole.project(T.R() * x.ray + x.idepth * T.translation());
  }
  BaOptions options = to_the_end();
  options.min_idepth = 1e-3;
  BaResult result;
  const BaProblem found = solved(problem, GetParam(), options, &result);
  ASSERT_TRUE(result.usable);
  int at_floor = 0;
  for (const BaPoint& x : found.points) {
    EXPECT_GE(x.idepth, options.min_idepth);
    at_floor += x.idepth < 1.0001 * options.min_idepth;
  }
  EXPECT_GE(at_floor, 5);
}

TEST(BundleAdjustment, SolversAgree) {
  for (const uint64_t seed : {1, 2, 3, 4}) {
    SceneOptions o = hard_scene();
    o.seed = seed;
    const BaProblem start = perturb(make_scene(o), 0.05, 0.01, 0.2, seed + 100);
    BaResult schur, ceres;
    const BaProblem a = solved(start, "schur", to_the_end(), &schur);
    const BaProblem b = solved(start, "ceres", to_the_end(), &ceres);
    ASSERT_TRUE(schur.usable && ceres.usable);
    EXPECT_NEAR(schur.initial_cost, ceres.initial_cost, 1e-10 * ceres.initial_cost);
    EXPECT_NEAR(schur.final_cost, ceres.final_cost, 1e-8 * ceres.final_cost);
    EXPECT_LT(pose_difference(a, b), 1e-5);
    EXPECT_LT(depth_difference(a, b), 1e-5);
  }
}

// Not only the same minimum but the same steps: a wrong entry of the normal equations shows in the first one.
TEST(BundleAdjustment, SolversTakeTheSameSteps) {
  const BaProblem start = perturb(make_scene(hard_scene()), 0.05, 0.01, 0.2, 9);
  for (const int iterations : {1, 2, 4, 8}) {
    BaOptions options;
    options.max_iterations = iterations;
    options.relative_decrease = 0;
    BaResult schur, ceres;
    const BaProblem a = solved(start, "schur", options, &schur);
    const BaProblem b = solved(start, "ceres", options, &ceres);
    EXPECT_EQ(schur.iterations, iterations);
    EXPECT_NEAR(schur.final_cost, ceres.final_cost, 1e-9 * ceres.final_cost);
    EXPECT_LT(pose_difference(a, b), 1e-9);
    EXPECT_LT(depth_difference(a, b), 1e-9);
  }
}

// Some known depths are wrong, and some belong to points whose depth is fixed.
BaProblem with_known_depths(BaProblem problem) {
  Random random(11);
  for (BaPoint& p : problem.points) {
    const double sigma = 0.02 * p.idepth;
    p.known_idepth = p.idepth + sigma * random.normal() * (random.uniform() < 0.1 ? 20 : 1);
    p.known_information = random.uniform() < 0.5 ? 1 / (sigma * sigma) : 0.0;
  }
  return problem;
}

TEST(BundleAdjustment, SolversTakeTheSameStepsWithKnownDepths) {
  const BaProblem start = perturb(with_known_depths(make_scene(hard_scene())), 0.05, 0.01, 0.2, 9);
  for (const int iterations : {1, 2, 4, 8}) {
    BaOptions options;
    options.max_iterations = iterations;
    options.relative_decrease = 0;
    BaResult schur, ceres;
    const BaProblem a = solved(start, "schur", options, &schur);
    const BaProblem b = solved(start, "ceres", options, &ceres);
    EXPECT_NEAR(schur.initial_cost, ceres.initial_cost, 1e-10 * ceres.initial_cost);
    EXPECT_NEAR(schur.final_cost, ceres.final_cost, 1e-9 * ceres.final_cost);
    EXPECT_LT(pose_difference(a, b), 1e-9);
    EXPECT_LT(depth_difference(a, b), 1e-9);
  }
}

// With one pose fixed, matches do not show the unit of length; the known depths are the true ones.
TEST_P(BundleAdjusters, KnownDepthsGiveTheUnit) {
  SceneOptions o;
  o.fixed_poses = 1;
  BaProblem truth = make_scene(o);
  for (BaPoint& p : truth.points) {
    p.known_idepth = p.idepth;
    p.known_information = 1 / (0.01 * p.idepth * p.idepth);
  }
  BaProblem start = truth;
  for (BaPoint& p : start.points) p.idepth /= 1.2;
  const SE3 T_first_world = start.poses[0].T_cam_world;
  for (BaPose& pose : start.poses) {
    const SE3 T = pose.T_cam_world * T_first_world.inverse();
    pose.T_cam_world = SE3(T.rotation(), 1.2 * T.translation()) * T_first_world;
  }
  BaResult result;
  const BaProblem found = solved(start, GetParam(), to_the_end(), &result);
  ASSERT_TRUE(result.usable);
  EXPECT_LT(pose_difference(found, truth), 1e-6);
}

TEST(BundleAdjustment, TwoMatchesOfAPointInOnePoseBothCount) {
  SceneOptions o = hard_scene();
  BaProblem start = make_scene(o);
  std::vector<BaObservation> doubled;
  for (const BaObservation& m : start.observations) {
    doubled.push_back(m);
    if (m.point % 3 != 0) continue;
    doubled.push_back(m);
    doubled.back().px += Eigen::Vector2d(0.3, -0.2);
  }
  start.observations = doubled;
  start = perturb(start, 0.05, 0.01, 0.2, 9);
  BaOptions options;
  options.relative_decrease = 0;
  BaResult schur, ceres;
  const BaProblem a = solved(start, "schur", options, &schur);
  const BaProblem b = solved(start, "ceres", options, &ceres);
  EXPECT_NEAR(schur.final_cost, ceres.final_cost, 1e-9 * ceres.final_cost);
  EXPECT_LT(pose_difference(a, b), 1e-9);
}

}  // namespace
}  // namespace edgevo
