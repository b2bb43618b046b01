// SPDX-License-Identifier: BSD-3-Clause
// The facade: every type that a program needs comes with this header, and edgevo/sources.h for files.
#include "edgevo/edgevo.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <thread>
#include <type_traits>
#include <utility>

#include "edgevo/sources.h"
#include "support/hollow_scene.h"
#include "support/temp_folder.h"

namespace edgevo::test {
namespace {

constexpr int kFrames = 40;

std::vector<Frame> sweep() {
  const HollowScene scene;
  std::vector<Frame> frames;
  for (int k = 0; k < kFrames; ++k)
    frames.push_back(
        {k, Timestamp::from_seconds(0.05 * k), scene.render(sweep_pose(k), 1, 0, 1.5, uint64_t(k + 1))});
  return frames;
}

// What a program sees of a run, frame by frame and at its end.
struct Outcome {
  std::vector<FrameRecord> live;
  Run run;
};

Outcome track(const std::vector<Frame>& frames, const OdometryOptions& options) {
  Odometry odometry(HollowScene().camera, {}, options);
  Outcome outcome;
  for (const Frame& frame : frames) outcome.live.push_back(odometry.process(frame));
  outcome.run = odometry.finish();
  return outcome;
}

// All poses and points of an outcome, to the last digit.
std::string digits(const Outcome& outcome) {
  std::string text;
  const auto add = [&text](double value) {
    char number[40];
    std::snprintf(number, sizeof number, "%a ", value);
    text += number;
  };
  const auto add_pose = [&](const SE3& T) {
    for (int i = 0; i < 3; ++i) add(T.translation()[i]);
    for (int i = 0; i < 4; ++i) add(T.rotation().coeffs()[i]);
  };
  for (const FrameRecord& f : outcome.live)
    if (f.T_world_cam_live) add_pose(*f.T_world_cam_live);
  for (const FrameRecord& f : outcome.run.frames)
    if (f.T_world_cam) add_pose(*f.T_world_cam);
  for (const KeyframeRecord& k : outcome.run.keyframes)
    for (const EdgePoint& p : k.points) add(double(p.idepth));
  return text;
}

OdometryOptions with_seed(uint64_t seed) {
  OdometryOptions options;
  options.seed = seed;
  return options;
}

TEST(Facade, TwoInstancesInTwoThreadsDoNotTouchEachOther) {
  const std::vector<Frame> frames = sweep();
  std::vector<Frame> reversed(frames.rbegin(), frames.rend());
  for (int k = 0; k < kFrames; ++k)
    reversed[size_t(k)].index = k, reversed[size_t(k)].time = frames[size_t(k)].time;
  const std::string alone = digits(track(frames, with_seed(1)));
  const std::string reversed_alone = digits(track(reversed, with_seed(2)));
  ASSERT_NE(alone, reversed_alone);
  std::string together, reversed_together;
  std::thread first([&] { together = digits(track(frames, with_seed(1))); });
  std::thread second([&] { reversed_together = digits(track(reversed, with_seed(2))); });
  first.join();
  second.join();
  EXPECT_EQ(together, alone);
  EXPECT_EQ(reversed_together, reversed_alone);
}

TEST(Facade, TwoRealtimeInstancesInTwoThreadsTrackEachItsOwnFrames) {
  const std::vector<Frame> frames = sweep();
  OdometryOptions options;
  options.realtime = true;
  Outcome outcomes[2];
  std::thread first([&] { outcomes[0] = track(frames, options); });
  std::thread second([&] { outcomes[1] = track(frames, options); });
  first.join();
  second.join();
  for (const Outcome& outcome : outcomes) {
    const auto posed = std::count_if(outcome.run.frames.begin(), outcome.run.frames.end(),
                                     [](const FrameRecord& f) { return f.T_world_cam.has_value(); });
    EXPECT_GE(posed, kFrames - 10);
  }
}

// A program may keep what it got for a frame: what is found later does not change it.
static_assert(std::is_same_v<decltype(std::declval<Odometry>().process(std::declval<Frame>())), FrameRecord>);

TEST(Facade, TheResultOfAFrameIsAValue) {
  const std::vector<Frame> frames = sweep();
  const Outcome outcome = track(frames, {});
  ASSERT_EQ(outcome.live.size(), outcome.run.frames.size());
  EXPECT_FALSE(outcome.live.front().T_world_cam_live) << "the bootstrap had not ended";
  EXPECT_TRUE(outcome.run.frames.front().T_world_cam) << "the bootstrap finds it afterwards";
  EXPECT_EQ(outcome.live.front().state, TrackingState::kBootstrapping);
}

TEST(Facade, EvaluatesARunAgainstAFile) {
  const TempFolder folder;
  const Outcome outcome = track(sweep(), {});
  std::ostringstream lines;
  for (int k = 0; k < kFrames; ++k) {
    const SE3 T = sweep_pose(k);
    const Eigen::Vector3d p = T.translation();
    const Eigen::Vector4d q = T.rotation().coeffs();
    lines << 0.05 * k << ' ' << p.transpose() << ' ' << q.transpose() << '\n';
  }
  const TrajectoryEvaluation e = evaluate(outcome.run, folder.write("truth.txt", lines.str()));
  EXPECT_EQ(e.coverage.input_frames, kFrames);
  EXPECT_GE(e.matched, kFrames - 10);
  EXPECT_LT(e.ate_sim3.rmse, 0.05);
}

TEST(Facade, AnErrorIsOneLine) {
  try {
    open_source("no/such/source");
    FAIL() << "opened";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("no/such/source"));
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace edgevo::test
