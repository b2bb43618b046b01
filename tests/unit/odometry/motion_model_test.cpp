// The motion model is private to the module, hence the path.
#include "../../../modules/odometry/src/motion_model.h"

#include <gtest/gtest.h>

#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

Timestamp at(double seconds) { return Timestamp::from_seconds(seconds); }
double difference(const SE3& a, const SE3& b) { return (a * b.inverse()).log().norm(); }

const SE3 kStep = SE3::exp(twist(0.1, 0, 0.3, 0, 0.02, 0));

// Frames 0.1 s apart, each `kStep` further than the one before.
MotionModel after_steps(int n) {
  MotionModel m;
  m.restart(at(0), SE3(), 0);
  SE3 T;
  for (int i = 1; i <= n; ++i) m.follow(at(0.1 * i), T = kStep * T);
  return m;
}

TEST(MotionModel, GoesOnAsBefore) {
  const MotionModel m = after_steps(3);
  EXPECT_LT(difference(m.predict(), kStep * kStep * kStep * kStep), 1e-12);
  EXPECT_LT(difference(m.starts().front(), m.predict()), 1e-12);
  ASSERT_TRUE(m.expected_twist());
  EXPECT_LT((*m.expected_twist() - kStep.log() / 0.1).norm(), 1e-9);
}

TEST(MotionModel, BridgesAGapAndTakesItsMeanVelocity) {
  MotionModel m = after_steps(2);
  m.begin_gap();
  m.miss(), m.miss();
  const SE3 expected = SE3::exp(3 * kStep.log()) * m.T_last_ref();
  EXPECT_LT(difference(m.starts().front(), expected), 1e-12);
  m.follow(at(0.5), expected);
  EXPECT_LT(difference(m.predict(), kStep * expected), 1e-12);
  EXPECT_LT((*m.expected_twist() - kStep.log() / 0.1).norm(), 1e-9);
}

TEST(MotionModel, AfterALongGapTheCameraIsSoughtWhereItWas) {
  MotionModel m = after_steps(2);
  for (int i = 0; i < 11; ++i) m.miss();
  EXPECT_LT(difference(m.starts().front(), m.T_last_ref()), 1e-12);
}

// Steady motion: the measured twist is the expected one. A faster step: half of the change comes on top.
TEST(MotionModel, TwistOfTheMomentOfTheImage) {
  const MotionModel m = after_steps(2);
  const Vector6d steady = kStep.log() / 0.1;
  EXPECT_LT((m.twist(at(0.3), kStep * m.T_last_ref()) - steady).norm(), 1e-9);
  EXPECT_LT((m.twist(at(0.3), SE3::exp(2 * kStep.log()) * m.T_last_ref()) - 2.5 * steady).norm(), 1e-9);
  EXPECT_EQ(m.twist(at(0.2), kStep * m.T_last_ref()), Vector6d::Zero());  // no time has passed
}

TEST(MotionModel, WithoutTimesNothingIsExpected) {
  MotionModel m;
  m.restart(at(1), kStep, 0);
  EXPECT_FALSE(m.expected_twist());
  EXPECT_LT(difference(m.predict(), kStep), 1e-12);
}

TEST(MotionModel, ANewReferenceReexpressesTheLastPose) {
  MotionModel m = after_steps(2);
  const SE3 T_old_new = SE3::exp(twist(0.2, 0.1, 0, 0.1, 0, 0)), last = m.T_last_ref();
  m.change_reference(T_old_new);
  EXPECT_LT(difference(m.T_last_ref(), last * T_old_new), 1e-12);
  EXPECT_LT(difference(m.predict(), kStep * last * T_old_new), 1e-12);
}

}  // namespace
}  // namespace edgevo
