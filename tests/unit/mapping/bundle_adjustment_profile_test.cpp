// Derivatives of the profile cost against the cost itself: the adjustment solved anew at displaced values of the unknown.
#include "../../../modules/mapping/src/radial_problem.h"

#include <gtest/gtest.h>

#include "bundle_adjustment_scene.h"

namespace edgevo {
namespace {

ba::RadialProblem radial_scene(uint64_t seed) {
  ba_scene::SceneOptions o;
  o.noise_px = 0.1;
  o.share_2d = 0.3;
  o.fixed_point_share = 0.1;
  o.seed = seed;
  ba::RadialProblem problem;
  problem.file = ba_scene::make_scene(o);
  for (const BaPoint& p : problem.file.points) problem.px_host.push_back(problem.file.pinhole.project(p.ray));
  return problem;
}

double profile_cost(const ba::RadialProblem& problem, double k1, BaProblem* solution) {
  *solution = ba::without_radial(problem, k1);
  return make_bundle_adjuster("schur")->solve(solution, ba_scene::to_the_end()).final_cost;
}

TEST(ProfileCost, GradientIsTheNumericOne) {
  for (const uint64_t seed : {1, 2, 3}) {
    const ba::RadialProblem problem = radial_scene(seed);
    const double k1 = 0.004, step = 1e-4;
    BaProblem solution, unused;
    profile_cost(problem, k1, &solution);
    const ba::ProfileStep s = ba::profile_step(solution, ba::k1_derivative(problem, k1), ba_scene::to_the_end());
    ASSERT_TRUE(s.usable);
    const double numeric = (profile_cost(problem, k1 + step, &unused) - profile_cost(problem, k1 - step, &unused)) / (2 * step);
    // The weights D^T n of the matches move with k1 too, which the derivative leaves out: second order in the residual.
    EXPECT_NEAR(s.gradient, numeric, 0.02 * std::abs(numeric));
  }
}

TEST(ProfileCost, RatesPredictTheNextSolution) {
  const ba::RadialProblem problem = radial_scene(4);
  BaProblem here, there;
  profile_cost(problem, 0, &here);
  const ba::ProfileStep s = ba::profile_step(here, ba::k1_derivative(problem, 0), ba_scene::to_the_end());
  const double change = 1e-3;
  profile_cost(problem, change, &there);
  BaProblem predicted = there;
  for (size_t i = 0; i < here.poses.size(); ++i)
    predicted.poses[i].T_cam_world = SE3::exp(change * s.pose_rate.segment<6>(6 * i)) * here.poses[i].T_cam_world;
  EXPECT_LT(ba_scene::pose_difference(predicted, there), 0.1 * ba_scene::pose_difference(here, there));
}

TEST(ProfileCost, NewtonFindsTheMinimum) {
  const ba::RadialProblem problem = radial_scene(5);
  const ba::RadialEstimate e = ba::estimate_k1(problem, 0, 1e3, 0.1, ba_scene::to_the_end());
  ASSERT_TRUE(e.usable);
  BaProblem unused;
  const double best = profile_cost(problem, e.k1, &unused);
  EXPECT_LE(best, profile_cost(problem, e.k1 + 3 * e.sigma, &unused));
  EXPECT_LE(best, profile_cost(problem, e.k1 - 3 * e.sigma, &unused));
}

}  // namespace
}  // namespace edgevo
