// SPDX-License-Identifier: BSD-3-Clause
// A rotation between two keyframes by another sensor: derivatives, and the same solution by both solvers.
#include "residuals/turn_residual.h"

#include <gtest/gtest.h>

#include "edgevo/core/rotation_vector.h"

namespace edgevo::test {
namespace {

// Three free poses that a weak prior holds, and two turns that they do not have.
BaProblem three_poses() {
  BaProblem problem;
  problem.pinhole = {400, 400, 320, 240, 640, 480};
  BaPrior prior;
  prior.H = 1e2 * Eigen::MatrixXd::Identity(18, 18);
  prior.b = Eigen::VectorXd::Zero(18);
  for (int i = 0; i < 3; ++i) {
    Vector6d xi;
    xi << 0.3 * i, 0.1, -0.2 * i, 0.1 * i, -0.2 * i, 0.05;
    problem.poses.push_back({SE3::exp(xi), false});
    problem.pose_ids.push_back(i);
    prior.pose_ids.push_back(i);
    prior.linearization.push_back(SE3::exp(xi));
  }
  problem.prior = prior;
  Eigen::Matrix3d information = Eigen::Vector3d(1e6, 4e6, 2e6).asDiagonal();
  information(0, 1) = information(1, 0) = 5e5;
  for (int i = 0; i < 2; ++i) {
    const SE3 T = problem.poses[size_t(i) + 1].T_cam_world * problem.poses[size_t(i)].T_cam_world.inverse();
    const Eigen::Quaterniond more = rotation_of(Eigen::Vector3d(2e-4, -1e-4 * i, 1e-4));
    problem.turns.push_back({i, i + 1, more * T.rotation(), information});
  }
  return problem;
}

TEST(TurnTerm, GradientIsThatOfTheCost) {
  const BaProblem problem = three_poses();
  const ba::TurnTerm term(problem.turns, 1e9);
  std::vector<SE3> poses;
  for (const BaPose& p : problem.poses) poses.push_back(p.T_cam_world);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(18, 18);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(18);
  EXPECT_NEAR(term.add(poses, &H, &b), term.cost(poses), 1e-12);
  constexpr double kStep = 1e-7;
  for (int i = 0; i < 18; ++i) {
    std::vector<SE3> more = poses, less = poses;
    Vector6d xi = Vector6d::Zero();
    xi[i % 6] = kStep;
    more[size_t(i / 6)] = SE3::exp(xi) * poses[size_t(i / 6)];
    less[size_t(i / 6)] = SE3::exp(-xi) * poses[size_t(i / 6)];
    EXPECT_NEAR((term.cost(more) - term.cost(less)) / (2 * kStep), b[i], 1e-3 * b.norm());
  }
}

TEST(TurnTerm, BothSolversTurnThePoses) {
  for (const char* name : {"schur", "ceres"}) {
    BaProblem problem = three_poses();
    BaOptions options;
    options.max_iterations = 20;
    ASSERT_TRUE(make_bundle_adjuster(name)->solve(&problem, options).usable) << name;
    for (const BaTurn& t : problem.turns) {
      const SE3 T =
          problem.poses[size_t(t.to)].T_cam_world * problem.poses[size_t(t.from)].T_cam_world.inverse();
      EXPECT_LT(ba::turn_residual(T, t).norm(), 2e-6) << name;
    }
  }
}

TEST(TurnTerm, MarginalisationKeepsWhatATurnSays) {
  BaProblem problem = three_poses();
  problem.prior->H *= 1e-6;
  std::vector<bool> dropped;
  const BaPrior prior = marginalize(problem, 0, {}, &dropped, nullptr);
  // Of pose 1 nothing more is known than before, since pose 0 is free.
  ASSERT_EQ(prior.pose_ids.size(), 2u);
  const Eigen::MatrixXd before = problem.prior->H.bottomRightCorner(12, 12);
  EXPECT_GT((prior.H - before).norm(), 1e-6 * before.norm());
}

}  // namespace
}  // namespace edgevo::test
