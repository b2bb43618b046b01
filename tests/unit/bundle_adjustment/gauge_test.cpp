// SPDX-License-Identifier: BSD-3-Clause
// The length of the baseline as a prior: a standard deviation of 1e-4 along it, no constraint across it.
#include "edgevo/bundle_adjustment/gauge.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

double cost(const BaPrior& prior, const Vector6d& xi) {
  return 0.5 * xi.dot(prior.H * xi) + prior.b.dot(xi) + prior.constant;
}

Vector6d translation(const Eigen::Vector3d& v) {
  Vector6d xi = Vector6d::Zero();
  xi.head<3>() = v;
  return xi;
}

TEST(FixBaseline, FixesTheLengthAndNothingElse) {
  const SE3 first(Eigen::Quaterniond(0.9, 0.1, -0.2, 0.05), {1, 2, 3}),
      last(Eigen::Quaterniond(0.8, -0.1, 0.3, 0.2), {-2, 0.5, 4});
  const BaPrior prior = ba::fix_baseline(first, last, 7);
  ASSERT_EQ(prior.pose_ids, std::vector<int>{7});
  EXPECT_EQ(prior.linearization[0].matrix(), last.matrix());
  const Eigen::Vector3d way = (last * first.inverse()).translation(), across = way.unitOrthogonal();
  EXPECT_NEAR(cost(prior, translation(1e-4 * way)), 0.5, 1e-9);
  EXPECT_NEAR(cost(prior, translation(across)), 0, 1e-6);
  Vector6d turn = Vector6d::Zero();
  turn.tail<3>() << 0.1, 0.2, 0.3;
  EXPECT_EQ(cost(prior, turn), 0);
}

TEST(FixBaseline, IsEmptyWithoutABaseline) {
  const SE3 pose(Eigen::Quaterniond(0.9, 0.1, -0.2, 0.05), {1, 2, 3});
  const BaPrior prior = ba::fix_baseline(SE3(), SE3(), 0);
  EXPECT_TRUE(prior.H.isZero(0.0));
  EXPECT_TRUE(prior.b.isZero(0.0));
  EXPECT_TRUE(ba::fix_baseline(pose, pose, 0).H.allFinite());
}

}  // namespace
}  // namespace edgevo
