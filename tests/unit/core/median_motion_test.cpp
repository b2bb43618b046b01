// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/median_motion.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

constexpr int kKnown = 29;  // frames until the median step is known: nine in a row, then twenty

// Steps along z of 0.1 that differ from it by 0.01, alternately.
Eigen::Vector3d swaying(int i) { return {0, 0, i % 2 == 0 ? 0.11 : 0.09}; }

MedianMotion after(int frames) {
  MedianMotion m;
  for (int i = 0; i < frames; ++i) m.follow(swaying(i), false);
  return m;
}

TEST(MedianMotion, IsKnownAfterSomeFrames) {
  EXPECT_FALSE(after(kKnown - 1).median_step());
  const auto step = after(kKnown + 40).median_step();
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->translation.z(), 0.1, 0.011);
  EXPECT_EQ(step->translation.x(), 0);
  EXPECT_GT(step->sigma.z(), 0.005);
  EXPECT_LT(step->sigma.z(), 0.025);
}

TEST(MedianMotion, OneJumpDoesNotMoveTheMedian) {
  MedianMotion m = after(kKnown + 40);
  const MedianMotion::Step before = *m.median_step();
  m.follow({5, 5, 5}, false);
  const MedianMotion::Step now = *m.median_step();
  EXPECT_LT((now.translation - before.translation).norm(), 0.021);
}

// Steps that the prior itself decided on do not reduce the standard deviation.
TEST(MedianMotion, HeldStepsDoNotChangeTheSigma) {
  MedianMotion m = after(kKnown + 40);
  const double before = m.median_step()->sigma.z();
  for (int i = 0; i < 100; ++i) m.follow(m.median_step()->translation, true);
  EXPECT_EQ(m.median_step()->sigma.z(), before);
}

TEST(MedianMotion, AGapInterrupts) {
  MedianMotion m = after(kKnown + 40);
  m.interrupt();
  EXPECT_FALSE(m.median_step());
  for (int i = 0; i < 9; ++i) m.follow(swaying(i), false);
  EXPECT_TRUE(m.median_step());  // the standard deviations have been kept
}

}  // namespace
}  // namespace edgevo
