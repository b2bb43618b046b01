// SPDX-License-Identifier: BSD-3-Clause
// Tracking and mapping in two threads. Run under ThreadSanitizer by the tsan preset.
#include <gtest/gtest.h>

#include <atomic>

#include "edgevo/core/error.h"
#include "support/wait.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::run_sweep;
using test::sweep_frame;
using test::sweep_pose;
using test::trajectory_error;

OdometryOptions realtime() {
  OdometryOptions options;
  options.realtime = true;
  return options;
}

TEST(Realtime, FinishesWithAPoseForEveryFrame) {
  constexpr int kFrames = 80;
  const auto run = run_sweep(kFrames, realtime());
  ASSERT_EQ(run.frames.size(), size_t(kFrames));
  const auto e = trajectory_error(run, 0, kFrames, sweep_pose);
  EXPECT_EQ(e.poses, kFrames);
  EXPECT_LT(e.rmse, 0.04 * e.length);
  EXPECT_GT(run.keyframes.size(), 3u);
}

TEST(Realtime, SurvivesABlackout) {
  constexpr int kBegin = 40, kEnd = 60, kAll = 100;
  const auto run = run_sweep(kAll, realtime(), kBegin, kEnd);
  ASSERT_EQ(run.frames.size(), size_t(kAll));
  for (int k = kBegin; k < kEnd; ++k) EXPECT_EQ(run.frames[size_t(k)].state, TrackingState::kLost) << k;
  EXPECT_EQ(trajectory_error(run, 0, kBegin, sweep_pose).poses, kBegin);
  EXPECT_GT(trajectory_error(run, kEnd, kAll, sweep_pose).poses, 10);
}

// As when an exception passes through the caller: the threads end with work in their queues, and no callback
// is called any more.
TEST(Realtime, EndsCleanlyWithoutFinish) {
  run_sweep(25, realtime());  // threads that a library keeps exist from now on
  const int threads = test::threads_of_process();
  std::atomic<int> said{0};
  OdometryOptions options = realtime();
  options.log = [&](const std::string&) { ++said; };
  {
    Odometry odometry(test::sweep_camera(), OdometryParams(), options);
    for (int k = 0; k < 25; ++k) EXPECT_EQ(odometry.process(sweep_frame(k)).index, k);
    EXPECT_GT(test::threads_of_process(), threads);
  }
  EXPECT_TRUE(test::have_ended_down_to(threads));
  EXPECT_GT(said, 0) << "there was a map";
}

TEST(Realtime, EndsCleanlyWithoutFrames) {
  Odometry odometry(test::sweep_camera(), OdometryParams(), realtime());
  EXPECT_TRUE(odometry.finish().frames.empty());
}

TEST(Realtime, AnImageOfAnotherSizeThrowsInTheCaller) {
  Odometry odometry(test::sweep_camera(), OdometryParams(), realtime());
  for (int k = 0; k < 25; ++k) odometry.process(sweep_frame(k));
  Frame wrong = sweep_frame(25);
  wrong.image = test::make_image(8, 8, [](double, double) { return 0; });
  EXPECT_THROW(odometry.process(wrong), InputError);
  EXPECT_GE(odometry.finish().frames.size(), 25u);
}

// Frames of a live camera that were skipped for lack of time: each has its record, and tracking bridges the
// gap.
TEST(Realtime, SkippedFramesKeepTheirRow) {
  constexpr int kAll = 60, kBegin = 40, kEnd = 43;
  Odometry odometry(test::sweep_camera(), OdometryParams(), realtime());
  for (int k = 0; k < kAll; ++k) {
    const Frame frame = sweep_frame(k);
    if (k < kBegin || k >= kEnd)
      odometry.process(frame);
    else
      EXPECT_EQ(odometry.skip(frame, "no time").note, "no time");
  }
  const auto run = odometry.finish();
  ASSERT_EQ(run.frames.size(), size_t(kAll));
  for (int k = kBegin; k < kEnd; ++k) {
    EXPECT_EQ(run.frames[size_t(k)].state, TrackingState::kLost);
    EXPECT_FALSE(run.frames[size_t(k)].T_world_cam);
  }
  EXPECT_EQ(trajectory_error(run, kEnd, kAll, sweep_pose).poses, kAll - kEnd);
  for (int k = kEnd; k < kAll; ++k) EXPECT_EQ(run.frames[size_t(k)].segment, 0) << k;
  EXPECT_TRUE(run.realtime);
}

}  // namespace
}  // namespace edgevo
