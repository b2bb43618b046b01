// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/run_statistics.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

FrameRecord frame(int segment, bool posed, TrackingState state = TrackingState::kTracking) {
  FrameRecord f;
  f.segment = segment;
  f.state = state;
  if (posed) f.T_world_cam = SE3();
  return f;
}

TEST(RunCounts, CountARunWithALoss) {
  edgevo::Run run;
  run.frames = {frame(0, true), frame(0, true), frame(0, false, TrackingState::kLost), frame(-1, false),
                frame(1, true)};
  run.keyframes.resize(2);
  run.keyframes[0].points.resize(3);
  run.keyframes[1].points.resize(4);
  run.keyframes[1].lines.resize(1);
  const RunCounts counts = count(run);
  EXPECT_EQ(counts.frames, 5);
  EXPECT_EQ(counts.with_pose, 3);
  EXPECT_EQ(counts.lost, 1);
  EXPECT_EQ(counts.segments, 2);
  EXPECT_EQ(counts.keyframes, 2);
  EXPECT_EQ(counts.points, 7u);
  EXPECT_EQ(counts.lines, 1u);
  EXPECT_FALSE(counts.mostly_failed());
}

TEST(RunCounts, HalfOfTheFramesAreEnough) {
  edgevo::Run run;
  EXPECT_FALSE(count(run).mostly_failed()) << "a run without a frame has not failed";
  run.frames = {frame(0, true), frame(-1, false)};
  EXPECT_FALSE(count(run).mostly_failed());
  run.frames.push_back(frame(-1, false));
  EXPECT_TRUE(count(run).mostly_failed());
}

}  // namespace
}  // namespace edgevo
