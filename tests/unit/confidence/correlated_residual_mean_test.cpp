// SPDX-License-Identifier: BSD-3-Clause
// The error that neighbouring edges share, over frames and in the covariance that is reported.
#include "edgevo/confidence/correlated_residual_mean.h"

#include <gtest/gtest.h>

#include "edgevo/alignment/pose_covariance.h"
#include "edgevo/confidence/collect_evidence.h"

namespace edgevo {
namespace {

CorrelatedResidual frame(double explained_px2) { return {explained_px2, 100, Matrix6d::Zero()}; }

TEST(CorrelatedResidualMean, IsThatOfTheFirstFrameAtOnce) {
  EXPECT_NEAR(CorrelatedResidualMean().add(frame(50)), 0.5, 1e-12);
}

TEST(CorrelatedResidualMean, FramesByChanceBelowZeroCancelThoseAbove) {
  CorrelatedResidualMean mean;
  double variance = 1;
  for (int i = 0; i < 100; ++i) variance = mean.add(frame(i % 2 == 0 ? -10 : 10));
  EXPECT_LT(variance, 0.01);
  EXPECT_EQ(CorrelatedResidualMean().add(frame(-10)), 0) << "a variance is not negative";
}

TEST(CorrelatedResidualMean, FollowsTheMotionWithinAThirdOfASecond) {
  CorrelatedResidualMean mean;
  for (int i = 0; i < 50; ++i) mean.add(frame(0));
  double variance = 0;
  for (int i = 0; i < 10; ++i) variance = mean.add(frame(50));
  EXPECT_GT(variance, 0.3);
  EXPECT_LT(variance, 0.4);
}

TEST(ReportedCovariance, GrowsWithTheErrorThatEdgesShare) {
  TrackResult pose;
  Reference reference;
  reference.error_factor = 2;
  pose.covariance = 3 * Matrix6d::Identity();
  pose.smooth.covariance = 5 * Matrix6d::Identity();
  EXPECT_NEAR(reported_covariance(pose, reference)(3, 3), 6, 1e-12);
  pose.correlated_px2 = 0.1;
  EXPECT_NEAR(reported_covariance(pose, reference)(3, 3), 6 + 2 * kReferenceShare * 0.5, 1e-12);
}

}  // namespace
}  // namespace edgevo
