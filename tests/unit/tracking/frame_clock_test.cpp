// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/frame_clock.h"

#include <gtest/gtest.h>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

Timestamp at(double seconds) { return Timestamp::from_seconds(seconds); }

// After `n` frames 0.1 s apart, the last at 10 s.
FrameClock clock_after(int n) {
  FrameClock clock;
  for (int i = n - 1; i >= 0; --i) clock.tick(at(10 - 0.1 * i));
  return clock;
}

TEST(FrameClock, EvenFramesAreOneIntervalApart) {
  FrameClock clock;
  EXPECT_EQ(clock.tick(at(3)).seconds, 0);  // the first frame has no interval
  for (int i = 1; i < 30; ++i) {
    const FrameClock::Step step = clock.tick(at(3 + 0.1 * i));
    EXPECT_EQ(step.frames, 1);
    EXPECT_NEAR(step.seconds, 0.1, 1e-9);
  }
}

TEST(FrameClock, CountsSkippedFrames) {
  for (const int frames : {2, 3, 7, 40}) {
    const FrameClock::Step step = clock_after(20).tick(at(10 + 0.1 * frames));
    EXPECT_EQ(step.frames, frames);
    EXPECT_NEAR(step.seconds, 0.1 * frames, 1e-9);
  }
}

TEST(FrameClock, FindsTheUsualIntervalAmongGaps) {
  FrameClock clock = clock_after(20);
  double time = 10;
  for (const int frames : {1, 3, 1, 2, 1, 6, 1, 1, 4, 1, 2})
    EXPECT_EQ(clock.tick(at(time += 0.1 * frames)).frames, frames);
}

// As from a busy recorder, where sometimes most of the recent frames came after a gap.
TEST(FrameClock, FindsTheUsualIntervalIfAThirdIsMissing) {
  Random random(7);
  FrameClock clock = clock_after(20);
  double time = 10;
  int skipped = 0;
  for (int i = 0; i < 2000; ++i) {
    ++skipped;
    if (random.uniform() < 0.33) continue;
    EXPECT_EQ(clock.tick(at(time += 0.1 * skipped)).frames, skipped) << "frame " << i;
    skipped = 0;
  }
}

// Arrival times: a frame is late by up to 0.4 intervals, and the next one on time.
TEST(FrameClock, JitterHasABoundedEffect) {
  Random random(4);
  FrameClock clock = clock_after(20);
  int frames = 0;
  double shortest = 1, longest = 0;
  for (int i = 1; i <= 200; ++i) {
    const FrameClock::Step step = clock.tick(at(10 + 0.1 * i + random.uniform(0, 0.04)));
    frames += step.frames;
    shortest = std::min(shortest, step.seconds), longest = std::max(longest, step.seconds);
  }
  EXPECT_EQ(frames, 200);
  EXPECT_GT(shortest, 0.04);
  EXPECT_LT(longest, 0.16);
}

TEST(FrameClock, NoFrameLastsLessThanHalfAnInterval) {
  const FrameClock::Step step = clock_after(20).tick(at(10.000001));
  EXPECT_EQ(step.frames, 1);
  EXPECT_NEAR(step.seconds, 0.05, 1e-9);
}

TEST(FrameClock, AdaptsToAnotherRate) {
  FrameClock clock = clock_after(20);
  for (int i = 1; i <= 13; ++i) clock.tick(at(10 + 0.3 * i));
  EXPECT_EQ(clock.tick(at(10 + 0.3 * 14)).frames, 1);
}

TEST(FrameClock, TimesThatDoNotIncreaseCarryNoInformation) {
  FrameClock clock = clock_after(20);
  for (const double time : {10.0, 9.0, 9.0}) {
    const FrameClock::Step step = clock.tick(at(time));
    EXPECT_EQ(step.frames, 1);
    EXPECT_EQ(step.seconds, 0);
  }
}

TEST(FrameClock, ALongPauseIsBounded) {
  EXPECT_EQ(clock_after(20).tick(at(1e7)).frames, FrameClock::kMaxFrames);
}

}  // namespace
}  // namespace edgevo
