// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/turn_by_gyro.h"

#include <gtest/gtest.h>

#include <cmath>

#include "consistency_tests.h"
#include "edgevo/confidence/motion_confidence.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo {
namespace {

constexpr double kStepDeg = 2;  // the camera turns by so much from frame to frame

Timestamp time_of(int k) { return Timestamp::from_seconds(0.05 * k); }
Eigen::Quaterniond turned(double degrees) { return rotation_of(rad(degrees) * Eigen::Vector3d::UnitY()); }

// A gyro that is right to `sigma_deg`.
TurnByGyro::Turn gyro(double sigma_deg) {
  return [=](Timestamp a, Timestamp b) {
    CameraTurn turn;
    turn.R = turned(kStepDeg * seconds_between(a, b) / 0.05);
    turn.covariance = std::pow(rad(sigma_deg), 2) * Eigen::Matrix3d::Identity();
    return std::optional<CameraTurn>(turn);
  };
}

TEST(TurnByGyro, ComparesTheLastTenFrames) {
  TurnByGyro compare;
  // From frame 10 on the poses turn by half a degree a frame too much.
  for (int k = 0; k <= 30; ++k) {
    const TurnDifference d =
        compare.add(time_of(k), turned(kStepDeg * k + 0.5 * std::max(0, k - 10)), gyro(0.2));
    const double expected = 0.5 * std::min(10, std::max(0, k - 10));
    EXPECT_NEAR(d.angle_deg, expected, 1e-3) << k;
    if (expected > 0) {
      EXPECT_NEAR(d.sigma_deg, 0.2, 1e-6) << k;
    }
  }
  compare.interrupt();
  EXPECT_NEAR(compare.add(time_of(31), turned(0), gyro(0.2)).angle_deg, 0, 1e-3);
}

TEST(TurnByGyro, SaysNothingWithoutAGyroThatKnows) {
  TurnByGyro compare;
  const auto none = [](Timestamp, Timestamp) { return std::optional<CameraTurn>(); };
  for (int k = 0; k < 12; ++k)
    EXPECT_TRUE(std::isnan(compare.add(time_of(k), turned(9.0 * k), none).angle_deg));
  EXPECT_EQ(probability_of_wrong_turn(std::nan(""), std::nan("")), 0);
}

TEST(TurnByGyro, DoubtsWhatASureGyroContradictsAndNotWhatAnUnsureOneDoes) {
  EXPECT_GT(probability_of_wrong_turn(6, 0.2), 0.99);
  EXPECT_LT(probability_of_wrong_turn(1, 0.2), 0.01);
  EXPECT_LT(probability_of_wrong_turn(6, 10), 0.05);
  EXPECT_LT(probability_of_wrong_turn(0, 100), 0.011);
}

TEST(TurnByGyro, AWrongTurnIsDoubtedWithItsReason) {
  FrameEvidence evidence;
  evidence.median_depth = 10, evidence.residual_px = 0.5;
  evidence.pose_sigmas.fill(1e-4);
  MotionHistory::Newest motion;
  motion.step = motion.usual = motion.usual_before = motion.recent = 0.1, motion.length = 1;
  ConfidenceInput frame{evidence, motion};
  const FrameConfidence without = MotionConfidence().add(frame);
  frame.by_gyro = {0.3, 0.1};
  const FrameConfidence agreeing = MotionConfidence().add(frame);
  frame.by_gyro = {6, 0.1};
  const FrameConfidence contradicted = MotionConfidence().add(frame);
  EXPECT_GT(without.p_right, kDoubtfulBelow);
  EXPECT_NEAR(agreeing.p_right, without.p_right, 1e-6);
  EXPECT_LT(contradicted.p_right, 0.01);
  ASSERT_FALSE(contradicted.reasons.empty());
  EXPECT_EQ(contradicted.reasons.front().kind, ReasonKind::kRotationByGyro);
}

}  // namespace
}  // namespace edgevo
