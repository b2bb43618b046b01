// SPDX-License-Identifier: BSD-3-Clause
// A marginalisation prior must have a minimum, whatever is lost to rounding.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

using namespace test;

// A large curvature that only the leaving pose accounts for cancels, and its rounding must not turn a weak
// direction into one without a minimum.
TEST(BundleAdjustmentMarginalize, APriorHasNoNegativeCurvature) {
  BaProblem problem;
  problem.pinhole = pinhole();
  BaPrior prior;
  for (int i = 0; i < 3; ++i) {
    problem.poses.push_back({SE3(Eigen::Quaterniond::Identity(), {0.1 * i, 0, 0}), false});
    problem.pose_ids.push_back(i);
    prior.pose_ids.push_back(i);
    prior.linearization.push_back(problem.poses.back().T_cam_world);
  }
  Random random(5);
  Eigen::MatrixXd A(18, 12);
  for (int i = 0; i < A.size(); ++i) A.data()[i] = random.normal();
  A.leftCols<6>() *= 1e4;
  prior.H = A * A.transpose();
  prior.b = prior.H * Eigen::VectorXd::Constant(18, 1e-3);
  prior.constant = 1;
  problem.prior = prior;
  std::vector<bool> drop;
  const BaPrior rest = marginalize(problem, 0, to_the_end(), &drop);
  ASSERT_EQ(rest.pose_ids.size(), 2u);
  const Eigen::VectorXd curvature = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(rest.H).eigenvalues();
  EXPECT_GT(curvature.maxCoeff(), 0.1) << "six directions stay known";
  EXPECT_GT(curvature.minCoeff(), -1e-13 * curvature.maxCoeff());
}

}  // namespace
}  // namespace edgevo
