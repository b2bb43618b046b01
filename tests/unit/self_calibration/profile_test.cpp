// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of the profile cost compared with the cost itself: the adjustment is solved again at displaced
// unknowns.
#include "camera_problem.h"

#include <gtest/gtest.h>

#include "support/bundle_adjustment_scene.h"
#include "support/numerical_jacobian.h"

namespace edgevo {
namespace {

CameraProblem camera_scene(uint64_t seed) {
  test::SceneOptions o;
  o.noise_px = 0.1;
  o.share_2d = 0.3;
  o.fixed_point_share = 0.1;
  o.seed = seed;
  CameraProblem problem;
  problem.file = test::make_scene(o);
  problem.rectification = problem.file.pinhole;
  for (const BaPoint& p : problem.file.points) problem.px_host.push_back(problem.file.pinhole.project(p.ray));
  Random random(seed + 100);
  for (size_t i = 0; i < problem.file.poses.size(); ++i) {
    ImageMotion motion;
    motion.velocity = test::random_tangent(&random, 1, 0.3);
    motion.idepth.setConstant(0.1);
    problem.motion.push_back(motion);
  }
  return problem;
}

double profile_cost(const CameraProblem& problem, const ba::Unknowns& k, BaProblem* solution) {
  *solution = corrected(problem, correction(k));
  return make_bundle_adjuster("schur")->solve(solution, test::to_the_end()).final_cost;
}

TEST(ProfileCost, GradientIsTheNumericOne) {
  for (const uint64_t seed : {1, 2, 3}) {
    const CameraProblem problem = camera_scene(seed);
    const ba::Unknowns k(0.004, 0.0008);
    BaProblem solution, unused;
    profile_cost(problem, k, &solution);
    const ba::ProfileStep s =
        ba::profile_step(solution, camera_derivative(problem, correction(k)), test::to_the_end());
    ASSERT_TRUE(s.usable);
    const auto cost = [&](const ba::Unknowns& d) { return profile_cost(problem, k + d, &unused); };
    const auto numeric = test::numerical_jacobian<ba::kUnknowns>(cost);
    // The weights D^T n of the matches depend on k too, which the derivative ignores: second order in the
    // residual.
    for (int i = 0; i < ba::kUnknowns; ++i)
      EXPECT_NEAR(s.gradient[i], numeric(0, i), 0.02 * std::abs(numeric(0, i))) << i;
  }
}

TEST(ProfileCost, RatesPredictTheNextSolution) {
  const CameraProblem problem = camera_scene(4);
  BaProblem here, there;
  profile_cost(problem, {0, 0}, &here);
  const ba::ProfileStep s = ba::profile_step(here, camera_derivative(problem, {}), test::to_the_end());
  for (const ba::Unknowns& change :
       {ba::Unknowns(1e-3, 0), ba::Unknowns(0, 1e-3), ba::Unknowns(1e-3, -1e-3)}) {
    profile_cost(problem, change, &there);
    BaProblem predicted = there;
    const Eigen::VectorXd moved = s.pose_rate * change;
    for (size_t i = 0; i < here.poses.size(); ++i)
      predicted.poses[i].T_cam_world = SE3::exp(moved.segment<6>(6 * i)) * here.poses[i].T_cam_world;
    EXPECT_LT(test::pose_difference(predicted, there), 0.1 * test::pose_difference(here, there))
        << change.transpose();
  }
}

CameraEstimate estimate(const CameraProblem& problem, bool k1, bool readout,
                        const ImageCorrection& start = {}) {
  CameraSearch search;
  search.start = start;
  search.free << k1, readout;
  search.prior_sigma << 1e3, 1e3;
  search.limit << 0.1, 0.1;
  return estimate_camera(problem, search, test::to_the_end());
}

TEST(ProfileCost, NewtonFindsTheMinimum) {
  const CameraProblem problem = camera_scene(5);
  const CameraEstimate e = estimate(problem, true, true);
  ASSERT_TRUE(e.usable);
  BaProblem unused;
  const ba::Unknowns found = unknowns(e.value);
  const double best = profile_cost(problem, found, &unused);
  for (int i = 0; i < ba::kUnknowns; ++i)
    for (const double side : {-3.0, 3.0})
      EXPECT_LE(best, profile_cost(problem, found + side * e.sigma[i] * ba::Unknowns::Unit(i), &unused)) << i;
}

TEST(ProfileCost, FixedUnknownsStay) {
  const CameraProblem problem = camera_scene(6);
  const ImageCorrection start{0.002, 0.005};
  EXPECT_EQ(estimate(problem, true, false, start).value.readout_s, start.readout_s);
  EXPECT_EQ(estimate(problem, false, true, start).value.k1, start.k1);
  const CameraEstimate none = estimate(problem, false, false, start);
  EXPECT_EQ(none.value, start);
  // One step with all unknowns free leads most of the way to where both searches end.
  const ba::Unknowns both = unknowns(estimate(problem, true, true).value), from = unknowns(start);
  EXPECT_LT((none.if_all_free - both).cwiseQuotient(none.sigma).norm(),
            0.3 * (from - both).cwiseQuotient(none.sigma).norm());
}

}  // namespace
}  // namespace edgevo
