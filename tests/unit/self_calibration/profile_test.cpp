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

// k2, focal length and principal point alone.
ba::Unknowns with(double k2, double focal, double centre) { return of_each(0, 0, k2, focal, centre); }

double profile_cost(const CameraProblem& problem, const ba::Unknowns& k, BaProblem* solution) {
  *solution = corrected(problem, CameraError(k));
  return make_bundle_adjuster("schur")->solve(solution, test::to_the_end()).final_cost;
}

TEST(ProfileCost, GradientIsTheNumericOne) {
  for (const uint64_t seed : {1, 2, 3}) {
    const CameraProblem problem = camera_scene(seed);
    const ba::Unknowns k = CameraError(ImageCorrection{0.004, 0.0008}).unknowns() + with(0.003, 0.02, 0.004);
    BaProblem solution, unused;
    profile_cost(problem, k, &solution);
    const ba::ProfileStep s = ba::profile_step(
        solution, camera_derivative(problem, CameraError(k), ideal_points(problem, CameraError(k))),
        test::to_the_end());
    ASSERT_TRUE(s.usable);
    const auto cost = [&](const ba::Unknowns& d) { return profile_cost(problem, k + d, &unused); };
    const auto numeric = test::numerical_jacobian<ba::kUnknowns>(cost);
    // The weights D^T n of the matches depend on the distortion too, which the derivative ignores: second
    // order in the residual.
    for (int i = 0; i < ba::kUnknowns; ++i) {
      const double neglected = i == kK1 || i == kK2 ? 2 * cost(ba::Unknowns::Zero()) : 0;
      EXPECT_NEAR(s.gradient[i], numeric(0, i), 0.02 * std::abs(numeric(0, i)) + neglected) << i;
    }
  }
}

TEST(ProfileCost, TheFirstUnknownsAloneHaveTheSameNumbers) {
  const CameraProblem problem = camera_scene(2);
  const CameraError camera{ImageCorrection{0.004, 0.0008}};
  BaProblem solution;
  profile_cost(problem, camera.unknowns(), &solution);
  const ba::GlobalDerivative derivative = camera_derivative(problem, camera, ideal_points(problem, camera));
  const ba::ProfileStep all = ba::profile_step(solution, derivative, test::to_the_end()),
                        first = ba::profile_step(solution, derivative, test::to_the_end(), true);
  constexpr int kN = ba::kFirstUnknowns;
  ASSERT_TRUE(first.usable);
  EXPECT_EQ(first.gradient.head<kN>(), all.gradient.head<kN>());
  EXPECT_EQ((first.curvature.topLeftCorner<kN, kN>()), (all.curvature.topLeftCorner<kN, kN>()));
  EXPECT_EQ((first.score_square.topLeftCorner<kN, kN>()), (all.score_square.topLeftCorner<kN, kN>()));
  EXPECT_EQ(first.pose_rate.leftCols<kN>(), all.pose_rate.leftCols<kN>());
  ASSERT_EQ(first.idepth_rate.size(), all.idepth_rate.size());
  for (size_t i = 0; i < all.idepth_rate.size(); ++i)
    EXPECT_EQ(first.idepth_rate[i].head<kN>(), all.idepth_rate[i].head<kN>());
  EXPECT_TRUE(first.gradient.tail<ba::kUnknowns - kN>().isZero(0));
}

TEST(ProfileCost, RatesPredictTheNextSolution) {
  const CameraProblem problem = camera_scene(4);
  BaProblem here, there;
  profile_cost(problem, ba::Unknowns::Zero(), &here);
  const ba::ProfileStep s =
      ba::profile_step(here, camera_derivative(problem, {}, ideal_points(problem, {})), test::to_the_end());
  for (const ba::Unknowns& change :
       {of_each(1e-3, 0, 0, 0, 0), of_each(0, 1e-3, 0, 0, 0), of_each(1e-3, -1e-3, 0, 0, 0), with(1e-4, 0, 0),
        with(0, 1e-3, 0), with(0, 0, 1e-3)}) {
    profile_cost(problem, change, &there);
    BaProblem predicted = there;
    const Eigen::VectorXd moved = s.pose_rate * change;
    for (size_t i = 0; i < here.poses.size(); ++i)
      predicted.poses[i].T_cam_world = SE3::exp(moved.segment<6>(6 * i)) * here.poses[i].T_cam_world;
    EXPECT_LT(test::pose_difference(predicted, there), 0.1 * test::pose_difference(here, there))
        << change.transpose() << " here to there " << test::pose_difference(here, there);
  }
}

CameraEstimate estimate(const CameraProblem& problem, const CameraMask& free, const CameraError& start = {}) {
  CameraSearch search;
  search.start = start;
  search.free = free;
  search.prior_sigma.setConstant(1e3);
  return estimate_camera(problem, search, test::to_the_end());
}

TEST(ProfileCost, NewtonFindsTheMinimum) {
  const CameraProblem problem = camera_scene(5);
  for (const CameraMask& free : {only({kK1, kReadout}), only({kK1, kFocal, kCentreX, kCentreY}),
                                 only({kK1, kReadout, kK2, kFocal, kCentreX, kCentreY})}) {
    const CameraEstimate e = estimate(problem, free);
    ASSERT_TRUE(e.usable);
    BaProblem unused;
    const ba::Unknowns found = e.value.unknowns();
    const double best = profile_cost(problem, found, &unused);
    for (int i = 0; i < ba::kUnknowns; ++i)
      for (const double side : {-3.0, 3.0})
        if (free[i]) {
          EXPECT_LE(best, profile_cost(problem, found + side * e.sigma[i] * ba::Unknowns::Unit(i), &unused))
              << i;
        }
  }
}

// The images of a camera with another focal length, principal point and distortion than the file says.
TEST(ProfileCost, TheWholeCameraIsFound) {
  CameraProblem problem = camera_scene(7);
  const CameraError truth(of_each(0.02, 0, -0.01, 0.04, 0.01));
  const Pinhole& c = problem.file.pinhole;
  const auto by_file = [&](int pose, const Eigen::Vector2d& px) {
    return c.project(
        truth.to_file(problem.rectification, problem.motion_of(pose), c.ray(px).head<2>()).homogeneous());
  };
  for (size_t i = 0; i < problem.px_host.size(); ++i)
    problem.px_host[i] = by_file(problem.file.points[i].host, problem.px_host[i]);
  for (BaObservation& o : problem.file.observations) o.px = by_file(o.target, o.px);
  const CameraEstimate e = estimate(problem, only({kK1, kK2, kFocal, kCentreX, kCentreY}));
  ASSERT_TRUE(e.usable);
  const ba::Unknowns error = e.value.unknowns() - truth.unknowns();
  for (int i = 0; i < ba::kUnknowns; ++i) EXPECT_LE(std::abs(error[i]), 4 * e.sigma[i] + 1e-12) << i;
  EXPECT_LT(e.sigma[kFocal], 0.02);
}

TEST(ProfileCost, FixedUnknownsStay) {
  const CameraProblem problem = camera_scene(6);
  const ImageCorrection start{0.002, 0.005};
  EXPECT_EQ(estimate(problem, only({kK1}), start).value.correction.readout_s, start.readout_s);
  EXPECT_EQ(estimate(problem, only({kReadout}), start).value.correction.k1, start.k1);
  const CameraEstimate none = estimate(problem, only({}), start);
  EXPECT_EQ(none.value.unknowns(), CameraError(start).unknowns());
}

}  // namespace
}  // namespace edgevo
