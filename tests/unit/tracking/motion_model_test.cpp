// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/motion_model.h"

#include <gtest/gtest.h>

#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

Timestamp seconds(double t) { return Timestamp::from_seconds(t); }
double difference(const SE3& a, const SE3& b) { return (a * b.inverse()).log().norm(); }

const SE3 kFrameMotion = SE3::exp(twist(0.1, 0, 0.3, 0, 0.02, 0));

// Frames 0.1 s apart, each `kFrameMotion` further than the one before.
MotionModel after_steps(int n) {
  MotionModel m;
  m.begin_frame(seconds(0));
  m.restart(SE3());
  SE3 T;
  for (int i = 1; i <= n; ++i) {
    m.begin_frame(seconds(0.1 * i));
    m.follow(T = kFrameMotion * T);
  }
  return m;
}

TEST(MotionModel, PredictsConstantVelocity) {
  MotionModel m = after_steps(3);
  m.begin_frame(seconds(0.4));
  EXPECT_LT(difference(m.predict(), kFrameMotion * kFrameMotion * kFrameMotion * kFrameMotion), 1e-12);
  EXPECT_LT(difference(m.starts().front(), m.predict()), 1e-12);
  ASSERT_TRUE(m.expected_twist());
  EXPECT_LT((*m.expected_twist() - kFrameMotion.log() / 0.1).norm(), 1e-9);
}

TEST(MotionModel, AKnownRotationTakesThePlaceOfTheExtrapolatedOne) {
  MotionModel m = after_steps(3);
  const SE3 last = m.T_last_ref();
  for (const double t : {0.4, 0.5}) m.begin_frame(seconds(t));
  m.know_rotation(KnownRotation{{0.3, 0, 0}, {0, 0, 1}, {5, 0, 0}});
  Vector6d expected = 2 * kFrameMotion.log();
  expected.tail<3>() << 0.3, 0, 0;
  EXPECT_LT(difference(m.predict(), SE3::exp(expected) * last), 1e-12);
  EXPECT_LT(difference(m.starts().front(), m.predict()), 1e-12);
  EXPECT_LT(difference(m.starts().back(), kFrameMotion * kFrameMotion * last), 1e-12);
  EXPECT_EQ(m.expected_twist()->tail<3>(), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(m.turning(), Eigen::Vector3d(5, 0, 0));
  m.know_rotation(std::nullopt);
  EXPECT_LT(difference(m.predict(), kFrameMotion * kFrameMotion * last), 1e-12);
}

TEST(MotionModel, BridgesAGapWithItsMeanVelocity) {
  MotionModel m = after_steps(2);
  for (const double t : {0.3, 0.4, 0.5}) m.begin_frame(seconds(t));
  EXPECT_EQ(m.frames_since(), 3);
  const SE3 expected = SE3::exp(3 * kFrameMotion.log()) * m.T_last_ref();
  EXPECT_LT(difference(m.starts().front(), expected), 1e-12);
  EXPECT_LT(difference(m.predict(), expected), 1e-12);
  m.follow(expected);
  m.begin_frame(seconds(0.6));
  EXPECT_LT(difference(m.predict(), kFrameMotion * expected), 1e-12);
  EXPECT_LT((*m.expected_twist() - kFrameMotion.log() / 0.1).norm(), 1e-9);
}

// The source skipped four frames: the same as if they had been lost.
TEST(MotionModel, BridgesSkippedFrames) {
  MotionModel m = after_steps(5);
  m.begin_frame(seconds(1.0));
  EXPECT_EQ(m.frames_since(), 5);
  const SE3 expected = SE3::exp(5 * kFrameMotion.log()) * m.T_last_ref();
  EXPECT_LT(difference(m.starts().front(), expected), 1e-12);
  EXPECT_LT((m.twist(expected) - kFrameMotion.log() / 0.1).norm(), 1e-9);
  m.follow(expected);
  m.begin_frame(seconds(1.1));
  EXPECT_LT(difference(m.predict(), kFrameMotion * expected), 1e-12);
  EXPECT_LT((*m.expected_twist() - kFrameMotion.log() / 0.1).norm(), 1e-9);
}

TEST(MotionModel, ANewMapAfterAGapTakesTheMeanVelocity) {
  MotionModel m = after_steps(5);
  m.begin_frame(seconds(0.9));
  m.restart(SE3::exp(4 * kFrameMotion.log()));
  m.begin_frame(seconds(1.0));
  EXPECT_LT(difference(m.predict(), kFrameMotion), 1e-12);
  EXPECT_LT((*m.expected_twist() - kFrameMotion.log() / 0.1).norm(), 1e-9);
}

// At constant velocity the measured twist is the expected one. After a faster step half of the change is
// added.
TEST(MotionModel, TwistIsThatOfTheImage) {
  MotionModel m = after_steps(2);
  const Vector6d steady = kFrameMotion.log() / 0.1;
  EXPECT_EQ(m.twist(kFrameMotion * m.T_last_ref()), Vector6d::Zero());  // no frame has begun
  m.begin_frame(seconds(0.3));
  EXPECT_LT((m.twist(kFrameMotion * m.T_last_ref()) - steady).norm(), 1e-9);
  EXPECT_LT((m.twist(SE3::exp(2 * kFrameMotion.log()) * m.T_last_ref()) - 2.5 * steady).norm(), 1e-9);
}

TEST(MotionModel, WithoutTimesNoTwistIsExpected) {
  MotionModel m;
  m.begin_frame(seconds(1));  // the very first frame
  m.restart(kFrameMotion);
  EXPECT_FALSE(m.expected_twist());
  EXPECT_LT(difference(m.predict(), kFrameMotion), 1e-12);
}

TEST(MotionModel, ANewReferenceReexpressesTheLastPose) {
  MotionModel m = after_steps(2);
  const SE3 T_old_new = SE3::exp(twist(0.2, 0.1, 0, 0.1, 0, 0)), last = m.T_last_ref();
  m.change_reference(T_old_new);
  EXPECT_LT(difference(m.T_last_ref(), last * T_old_new), 1e-12);
  EXPECT_LT(difference(m.predict(), kFrameMotion * last * T_old_new), 1e-12);
}

TEST(MotionModel, AStepIsThatOfOneFrame) {
  MotionModel m = after_steps(30);
  const double usual = kFrameMotion.translation().norm();
  m.begin_frame(seconds(3.1));
  EXPECT_NEAR(m.step_to(kFrameMotion * m.T_last_ref()), usual, 1e-9);
  m.begin_frame(seconds(3.2));
  EXPECT_NEAR(m.step_to(kFrameMotion * m.T_last_ref()), usual / 2, 1e-9);
}

}  // namespace
}  // namespace edgevo
