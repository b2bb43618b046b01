// SPDX-License-Identifier: BSD-3-Clause
// Frames that come on a schedule of their own: the bootstrap runs next to them, and work is shed where they
// come too late. Run under ThreadSanitizer by the tsan preset.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "edgevo/map/map_log.h"
#include "edgevo/mapping/shedding.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::sweep_frame;
using test::sweep_pose;
using test::trajectory_error;

OdometryOptions on_schedule() {
  OdometryOptions options;
  options.realtime = true;
  options.on_schedule = true;
  options.max_frames_ahead = 3;
  return options;
}

// The next frame comes once the search has had time to take this one, on a machine of any speed.
void give_time(const FrameRecord& record) {
  if (!record.T_world_cam_live) std::this_thread::sleep_for(std::chrono::milliseconds(150));
}

TEST(OnSchedule, FramesAreAnsweredAtOnceAndGetTheirPosesLater) {
  constexpr int kFrames = 80;
  Odometry odometry(test::sweep_camera(), OdometryParams(), on_schedule());
  int in_the_making = -1;
  for (int k = 0; k < kFrames; ++k) {
    const FrameRecord record = odometry.process(sweep_frame(k));
    EXPECT_EQ(record.index, k);
    if (record.note.find("a map is being made") != std::string::npos) {
      EXPECT_EQ(record.state, TrackingState::kBootstrapping);
      EXPECT_FALSE(record.T_world_cam_live);
      in_the_making = k;
    }
    give_time(record);
  }
  const edgevo::Run run = odometry.finish();
  ASSERT_EQ(run.frames.size(), size_t(kFrames));
  ASSERT_GE(in_the_making, 0);
  // A search that is far behind, on a slow machine, may lose some frames before the map.
  for (const FrameRecord& f : run.frames) {
    if (f.index < in_the_making) continue;
    EXPECT_TRUE(f.T_world_cam) << f.index;
    EXPECT_EQ(f.segment, 0) << f.index;
  }
  const auto error = trajectory_error(run, 0, kFrames, sweep_pose);
  EXPECT_GE(error.poses, kFrames - in_the_making);
  EXPECT_LT(error.rmse, 0.04 * error.length);
}

TEST(OnSchedule, ALossIsFollowedByAnotherMapMadeMeanwhile) {
  constexpr int kBegin = 40, kEnd = 60, kAll = 110;
  Odometry odometry(test::sweep_camera(), OdometryParams(), on_schedule());
  for (int k = 0; k < kAll; ++k) {
    const bool is_black = k >= kBegin && k < kEnd;
    give_time(odometry.process(is_black ? test::black(sweep_frame(k)) : sweep_frame(k)));
  }
  const edgevo::Run run = odometry.finish();
  ASSERT_EQ(run.frames.size(), size_t(kAll));
  for (int k = kBegin; k < kEnd; ++k) EXPECT_FALSE(run.frames[size_t(k)].T_world_cam) << k;
  EXPECT_GT(trajectory_error(run, kEnd, kAll, sweep_pose).poses, 10);
}

// Keyframes in close succession call for corners: mapping waits for them, the frames do not.
TEST(OnSchedule, CornersAreSearchedNextToTheFrames) {
  constexpr int kFrames = 60;
  OdometryParams params;
  params.mapping.corners.max_inlier_share = 1;
  params.keyframe.flow_px = 8;
  Odometry odometry(test::sweep_camera(), params, on_schedule());
  for (int k = 0; k < kFrames; ++k) {
    const FrameRecord record = odometry.process(sweep_frame(k));
    for (const auto& [stage, ms] : record.stage_ms) EXPECT_NE(stage, "corners") << k;
    give_time(record);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));  // mapping is done when the next one comes
  }
  const edgevo::Run run = odometry.finish();
  int searched = 0;
  for (const FrameRecord& f : run.frames)
    for (const auto& [stage, ms] : f.stage_ms) searched += stage == "corners";
  EXPECT_GT(searched, 0);
  const auto error = trajectory_error(run, 0, kFrames, sweep_pose);
  EXPECT_GT(error.poses, kFrames / 2);
  EXPECT_LT(error.rmse, 0.04 * error.length);
}

// In the search, while the map is made, and afterwards.
TEST(OnSchedule, EndsCleanlyAtAnyFrame) {
  for (int frames = 0; frames < 30; frames += 3) {
    Odometry odometry(test::sweep_camera(), OdometryParams(), on_schedule());
    for (int k = 0; k < frames; ++k) odometry.process(sweep_frame(k));
    if (frames % 2 != 0) continue;
    EXPECT_EQ(odometry.finish().frames.size(), size_t(frames));
  }
}

TEST(OnSchedule, ASkippedFrameDoesNotStopTheMapInTheMaking) {
  Odometry odometry(test::sweep_camera(), OdometryParams(), on_schedule());
  for (int k = 0; k < 60; ++k) {
    if (k > 0 && k % 7 == 0) {
      odometry.skip(sweep_frame(k), "no time");
      continue;
    }
    const FrameRecord record = odometry.process(sweep_frame(k));
    give_time(record);
  }
  EXPECT_GT(trajectory_error(odometry.finish(), 30, 60, sweep_pose).poses, 20);
}

TEST(Shedding, SkipsWhatItSaysAndKeepsThePoses) {
  constexpr int kFrames = 80;
  OdometryOptions options;
  options.realtime = true;
  Odometry odometry(test::sweep_camera(), OdometryParams(), options);
  for (int k = 0; k < kFrames; ++k) {
    if (k == 30) odometry.shed(Shedding::kPoints);
    odometry.process(sweep_frame(k));
  }
  const edgevo::Run run = odometry.finish();
  ASSERT_TRUE(run.realtime);
  EXPECT_GT(run.realtime->shed.depths, 0);
  EXPECT_GT(run.realtime->shed.points, 0);
  const auto error = trajectory_error(run, 0, kFrames, sweep_pose);
  EXPECT_EQ(error.poses, kFrames);
  EXPECT_LT(error.rmse, 0.04 * error.length);
}

TEST(Shedding, NothingIsShedUnlessItIsRequested) {
  OdometryOptions options;
  options.realtime = true;
  const edgevo::Run run = test::run_sweep(60, options);
  EXPECT_EQ(run.realtime->shed.lines, 0);
  EXPECT_EQ(run.realtime->shed.depths, 0);
  EXPECT_EQ(run.realtime->shed.points, 0);
}

// The events hold everything: a run that forgets has the same ones.
TEST(Forgetting, ChangesNoEvent) {
  std::vector<std::vector<int>> keyframes(2);
  std::vector<std::vector<double>> depths(2);
  for (const bool forget : {false, true}) {
    OdometryOptions options;
    options.forget = forget;
    options.map_log = std::make_shared<MapLog>();
    MapCursor events(options.map_log);
    const edgevo::Run run = test::run_sweep(60, options);
    EXPECT_EQ(run.frames.size(), 60u) << "fewer than are kept";
    EXPECT_EQ(run.keyframes.empty(), forget);
    for (const auto& event : events.read())
      if (const auto* k = std::get_if<KeyframeMarginalised>(event.get())) {
        keyframes[forget].push_back(k->id);
        for (const EdgePoint& p : k->keyframe->points) depths[forget].push_back(p.idepth);
      }
  }
  EXPECT_FALSE(keyframes[0].empty());
  EXPECT_EQ(keyframes[0], keyframes[1]);
  EXPECT_EQ(depths[0], depths[1]);
}

}  // namespace
}  // namespace edgevo
