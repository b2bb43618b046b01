// SPDX-License-Identifier: BSD-3-Clause
// What adjusted keyframes show about the covariance of tracking.
#include "edgevo/confidence/tracking_check.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "edgevo/alignment/pose_covariance.h"
#include "edgevo/core/random.h"

namespace edgevo {
namespace {

Matrix6d some_covariance() {
  Vector6d sigma;
  sigma << 0.02, 0.01, 0.03, 0.001, 0.002, 0.0015;
  Matrix6d mix = Matrix6d::Identity();
  mix(0, 4) = 0.5, mix(1, 3) = -0.4, mix(2, 0) = 0.2;
  const Matrix6d root = sigma.asDiagonal() * mix;
  return root * root.transpose();
}

const SE3 kAdjusted = SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY())),
                          Eigen::Vector3d(0.1, 0.02, -0.9));

// Mean error factor of `keyframes` poses whose errors are `sigmas` times their covariance, without the first
// ten.
double mean_factor(double sigmas, int keyframes) {
  Random random(3);
  const Matrix6d root = some_covariance().llt().matrixL();
  TrackingCheck check;
  double sum = 0;
  for (int i = 0; i < keyframes; ++i) {
    Vector6d noise;
    for (double& x : noise) x = sigmas * random.normal();
    check.add(SE3::exp(root * noise) * kAdjusted, kAdjusted, some_covariance());
    if (i >= 10) sum += check.error_factor();
  }
  return sum / (keyframes - 10);
}

TEST(TrackingCheck, ANewMapIsTrustedLess) {
  TrackingCheck exact;
  const double young = exact.error_factor();
  EXPECT_GT(young, 1.5);
  for (int i = 0; i < 20; ++i) exact.add(kAdjusted, kAdjusted, some_covariance());
  EXPECT_LT(exact.error_factor(), 0.5 * young);
  EXPECT_GT(exact.error_factor(), 0.5);  // agreement is no proof
}

TEST(TrackingCheck, FollowsTheTrueVariance) {
  const double honest = mean_factor(1, 400);
  EXPECT_GT(honest, 1.0);
  EXPECT_LT(honest, 1.4);
  EXPECT_NEAR(mean_factor(1.5, 400) / honest, 2.1, 0.4);  // 2.25, less what is cut off above
}

TEST(TrackingCheck, ReturnsTheErrorOfEachKeyframe) {
  TrackingCheck check;
  EXPECT_NEAR(check.add(kAdjusted, kAdjusted, some_covariance()), 0, 1e-12);
  Vector6d two_sigmas = Vector6d::Zero();
  two_sigmas[4] = 2;
  const Matrix6d root = some_covariance().llt().matrixL();
  const SE3 tracked = SE3::exp(root * two_sigmas) * kAdjusted;
  EXPECT_NEAR(check.add(tracked, kAdjusted, some_covariance()),
              normalised_error_square(tracked, kAdjusted, some_covariance()) / kNormalisedErrorFreedom,
              1e-12);
  EXPECT_TRUE(std::isnan(
      check.add(kAdjusted, kAdjusted, Matrix6d::Constant(std::numeric_limits<double>::quiet_NaN()))));
}

TEST(TrackingCheck, OneOutlierDoesNotDecide) {
  TrackingCheck check;
  for (int i = 0; i < 20; ++i) check.add(kAdjusted, kAdjusted, some_covariance());
  check.add(SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(3, 0, 0)) * kAdjusted, kAdjusted,
            some_covariance());
  EXPECT_LT(check.error_factor(), 3);
  const double before = check.error_factor();
  check.add(kAdjusted, kAdjusted, Matrix6d::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(check.error_factor(), before);  // what cannot be evaluated changes nothing
}

// The unit of length of a monocular map is arbitrary.
TEST(TrackingCheck, AScaleDifferenceIsNoError) {
  TrackingCheck same, longer;
  const SE3 stretched(kAdjusted.rotation(), 1.05 * kAdjusted.translation());
  for (int i = 0; i < 5; ++i) {
    same.add(kAdjusted, kAdjusted, some_covariance());
    longer.add(stretched, kAdjusted, some_covariance());
  }
  EXPECT_NEAR(longer.error_factor(), same.error_factor(), 0.05 * same.error_factor());
}

}  // namespace
}  // namespace edgevo
