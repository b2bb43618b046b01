// SPDX-License-Identifier: BSD-3-Clause
// Every Jacobian of an observation against numeric differentiation, and points behind the camera.
#include <gmock/gmock.h>

#include "residuals/edge_residual.h"
#include "support/bundle_adjustment_scene.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

using namespace test;

struct Case {
  BaProblem problem;
  const BaObservation& observation(int i) const { return problem.observations[i]; }
  ba::EdgeLinearization at(int i, const SE3& move_target, const SE3& move_host, double move_idepth) const {
    const BaObservation& o = observation(i);
    BaPoint point = problem.points[o.point];
    point.idepth += move_idepth;
    return ba::linearize(problem.pinhole, move_target * problem.poses[o.target].T_cam_world,
                         move_host * problem.poses[point.host].T_cam_world, point, o);
  }
};

Case noisy_case() {
  SceneOptions o;
  o.points = 20;
  o.noise_px = 2;
  return {make_scene(o)};
}

TEST(BundleAdjustmentLinearize, PoseJacobiansAreTheDerivatives) {
  const Case c = noisy_case();
  for (int i = 0; i < static_cast<int>(c.problem.observations.size()); ++i) {
    const ba::EdgeLinearization lin = c.at(i, SE3(), SE3(), 0);
    ASSERT_TRUE(lin.valid);
    const auto by_target = [&](const Vector6d& d) { return c.at(i, SE3::exp(d), SE3(), 0).residual; };
    const auto by_host = [&](const Vector6d& d) { return c.at(i, SE3(), SE3::exp(d), 0).residual; };
    EXPECT_THAT(lin.J_target, JacobianNear(numerical_jacobian<6>(by_target, 1e-3), 1e-7));
    EXPECT_THAT(lin.J_host, JacobianNear(numerical_jacobian<6>(by_host, 1e-3), 1e-7));
  }
}

TEST(BundleAdjustmentLinearize, InverseDepthJacobianIsTheDerivative) {
  const Case c = noisy_case();
  for (int i = 0; i < static_cast<int>(c.problem.observations.size()); ++i) {
    const ba::EdgeLinearization lin = c.at(i, SE3(), SE3(), 0);
    const auto by_idepth = [&](const Eigen::Matrix<double, 1, 1>& d) {
      return c.at(i, SE3(), SE3(), d[0]).residual;
    };
    EXPECT_THAT(lin.J_idepth, JacobianNear(numerical_jacobian<1>(by_idepth), 1e-7));
  }
}

TEST(BundleAdjustmentLinearize, ResidualIsInTheAxesOfTheEdge) {
  const Pinhole camera = pinhole();
  const SE3 T_target_world(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-1, 0, 0));
  BaPoint point;
  point.ray = {0.1, 0.2, 1};
  point.idepth = 0.1;
  BaObservation o;
  o.normal = {0.6, 0.8};
  o.inv_sigma_normal = 2;
  o.inv_sigma_tangent = 3;
  const Eigen::Vector2d projected = camera.project({0.1 - 0.1, 0.2, 1});
  o.px = projected - 5 * o.normal - 7 * Eigen::Vector2d(-0.8, 0.6);
  const ba::EdgeLinearization lin = ba::linearize(camera, T_target_world, SE3(), point, o);
  ASSERT_TRUE(lin.valid);
  EXPECT_NEAR(lin.residual[0], 2 * 5, 1e-10);
  EXPECT_NEAR(lin.residual[1], 3 * 7, 1e-10);
}

TEST(BundleAdjustmentLinearize, AmbiguousMatchHasNoResidualAlongTheEdge) {
  Case c = noisy_case();
  for (BaObservation& o : c.problem.observations) o.inv_sigma_tangent = 0;
  for (int i = 0; i < static_cast<int>(c.problem.observations.size()); ++i) {
    const ba::EdgeLinearization lin = c.at(i, SE3(), SE3(), 0);
    EXPECT_EQ(lin.residual[1], 0);
    EXPECT_TRUE(lin.J_target.row(1).isZero(0) && lin.J_host.row(1).isZero(0));
    EXPECT_EQ(lin.J_idepth[1], 0);
  }
}

TEST(BundleAdjustmentLinearize, PointBehindTheCameraIsInvalidAndAllZero) {
  const Case c = noisy_case();
  const SE3 forward(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -100));
  const ba::EdgeLinearization lin = c.at(0, forward, SE3(), 0);
  EXPECT_FALSE(lin.valid);
  EXPECT_TRUE(lin.residual.isZero(0) && lin.J_target.isZero(0) && lin.J_host.isZero(0) &&
              lin.J_idepth.isZero(0));
}

}  // namespace
}  // namespace edgevo
