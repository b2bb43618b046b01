// SPDX-License-Identifier: BSD-3-Clause
// The recovery log is read back completely up to where the file ends.
#include "edgevo/results/recovery_log.h"

#include <gmock/gmock.h>

#include "edgevo/core/output_file.h"
#include "edgevo/core/random.h"
#include "edgevo/occupancy/edge_ply.h"
#include "edgevo/results/run_text.h"
#include "growing_file.h"
#include "written_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::content;
using ::testing::HasSubstr;

constexpr int kWindowKeyframes = 6;

class RecoveryLogs : public WrittenRun {
 protected:
  RecoveryLogs() { fs::create_directories(folder_); }

  static EdgeLine some_line() {
    EdgeLine line;
    line.vertices = {{{1, 2}, 0.5f, 0.1f, 3, 4}, {{5, 6}, 0.7f, 0.2f, 7, 8}};
    line.keyframes = 9;
    line.is_outline = true;
    return line;
  }

  RecoveryHeader header() const {
    RecoveryHeader h;
    h.info.command_line = {"edgevo", "run", "a \"quoted\" folder"};
    h.info.source_kind = "synthetic";
    h.info.camera = made_.camera;
    h.info.notes = {{"seed", "3"}};
    h.scale = "odometry";
    h.track.positions = {{Timestamp{5}, {1, 2, 3}}, {Timestamp{7}, {4, 5, 6}}};
    h.T_vehicle_cam = SE3(Eigen::Quaterniond::Identity(), {0, 0, 1.5});
    return h;
  }
  // Writes each frame and the keyframes marginalised by then, as a run does.
  void write_all(RecoveryLog* log) const {
    size_t next = 0;
    for (const FrameRecord& frame : made_.run.frames) {
      log->add_frame(frame);
      MarginalisedKeyframes marginalised;
      while (made_.run.keyframes[next].frame_index + 3 * kWindowKeyframes <= frame.index)
        marginalised.keyframes.push_back(made_.run.keyframes[next++]);
      log->add_keyframes(marginalised);
      log->add_camera({});
    }
  }
  std::string bytes() const { return content(folder_ / kRecoveryLog); }
  void put(const std::string& bytes) const { write_file((folder_ / kRecoveryLog).string(), bytes); }
  InterruptedRun read() const { return read_recovery_log(folder_.string()); }
  // The run as recovered if the program were killed now.
  edgevo::Run so_far() const {
    const test::TempFolder killed;
    write_file(killed / kRecoveryLog, bytes());
    if (fs::exists(folder_ / kRunWindow)) write_file(killed / kRunWindow, content(folder_ / kRunWindow));
    return read_recovery_log(killed.path()).run;
  }
};

TEST_F(RecoveryLogs, RestoresEverything) {
  {
    RecoveryLog log(folder_.string(), header());
    write_all(&log);
  }
  const InterruptedRun back = read();
  EXPECT_EQ(back.header.info.command_line, header().info.command_line);
  EXPECT_EQ(back.header.info.notes, header().info.notes);
  EXPECT_EQ(back.header.scale, "odometry");
  ASSERT_EQ(back.header.track.positions.size(), 2u);
  EXPECT_EQ(back.header.track.positions[1].position, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(back.run.T_vehicle_cam->translation().z(), 1.5);
  EXPECT_EQ(back.run.pinhole.fx, made_.camera.pinhole.fx);
  EXPECT_EQ(frames_csv(back.run), frames_csv(made_.run));
  EXPECT_EQ(trajectory_tum(back.run, PoseKind::kLive), trajectory_tum(made_.run, PoseKind::kLive));
  ASSERT_FALSE(back.run.keyframes.empty());
  ASSERT_EQ(back.frames_before_keyframe.size(), back.run.keyframes.size());
  EXPECT_EQ(back.frames_before_keyframe[0], size_t(3 * kWindowKeyframes + 1));
  edgevo::Run until_then = made_.run;
  until_then.T_vehicle_cam = back.run.T_vehicle_cam;
  until_then.keyframes.resize(back.run.keyframes.size());
  write_edge_ply(until_then, PointFilter(), temp_ / "written.ply");
  write_edge_ply(back.run, PointFilter(), temp_ / "read.ply");
  EXPECT_EQ(content(temp_ / "read.ply"), content(temp_ / "written.ply"));
}

TEST_F(RecoveryLogs, HoldsPosesFoundLaterByABootstrap) {
  RecoveryLog log(folder_.string(), header());
  std::vector<FrameRecord> frames(made_.run.frames.begin(), made_.run.frames.begin() + 6);
  for (FrameRecord& f : frames) f.T_world_cam_live = std::nullopt;
  for (int i = 0; i < 5; ++i) log.add_frame(frames[size_t(i)]);
  EXPECT_FALSE(so_far().frames[3].T_world_cam_live);
  for (FrameRecord& f : frames)
    f.T_world_cam_live = SE3(Eigen::Quaterniond::Identity(), {0.5, 0, double(f.index)});
  log.add_frame(frames[5]);
  EXPECT_EQ(so_far().frames[3].T_world_cam_live->translation().z(), 3);
}

TEST_F(RecoveryLogs, RestoresTheLatencyOfAFrame) {
  FrameRecord frame = made_.run.frames[5];
  frame.latency_ms = 12.5;
  RecoveryLog log(folder_.string(), header());
  log.add_frame(frame);
  log.add_frame(made_.run.frames[6]);
  const edgevo::Run back = so_far();
  ASSERT_EQ(back.frames.size(), 2u);
  EXPECT_EQ(back.frames[0].latency_ms, 12.5);
  EXPECT_FALSE(back.frames[1].latency_ms);
}

TEST_F(RecoveryLogs, RestoresTheLinesOfAKeyframe) {
  MarginalisedKeyframes marginalised;
  marginalised.keyframes = {made_.run.keyframes[0]};
  marginalised.keyframes[0].lines = {some_line()};
  RecoveryLog(folder_.string(), header()).add_keyframes(marginalised);
  const EdgeLine line = read().run.keyframes.at(0).lines.at(0);
  EXPECT_EQ(line.vertices.at(1).px, Eigen::Vector2f(5, 6));
  EXPECT_EQ(line.vertices.at(1).idepth_sigma, 0.2f);
  EXPECT_EQ(line.vertices.at(1).gray_bright, 8);
  EXPECT_EQ(line.keyframes, 9);
  EXPECT_TRUE(line.is_outline);
  EXPECT_FALSE(line.is_straight);
}

TEST_F(RecoveryLogs, ACorrectedCameraMovesAllKeyframesOrNone) {
  MarginalisedKeyframes marginalised;
  marginalised.keyframes = {made_.run.keyframes[0], made_.run.keyframes[1]};
  {
    RecoveryLog log(folder_.string(), header());
    log.add_keyframes(marginalised);
    marginalised.revision = 1;
    for (KeyframeRecord& k : marginalised.keyframes)
      k.T_world_cam = SE3(Eigen::Quaterniond::Identity(), {7, 8, 9});
    log.add_keyframes(marginalised);
    EXPECT_EQ(log.marginalised(), 2u);
    EXPECT_EQ(log.revision(), 1);
  }
  const InterruptedRun back = read();
  EXPECT_TRUE(back.camera_was_corrected);
  ASSERT_EQ(back.run.keyframes.size(), 2u);
  EXPECT_EQ(back.run.keyframes[1].T_world_cam.translation(), Eigen::Vector3d(7, 8, 9));
  put(bytes().substr(0, bytes().size() - 1));  // damages the record that completes the revision
  EXPECT_NE(read().run.keyframes[1].T_world_cam.translation(), Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(read().run.keyframes.size(), 2u);
}

TEST_F(RecoveryLogs, TheWindowFollowsTheMarginalisedKeyframes) {
  const auto& made = made_.run.keyframes;
  RecoveryLog log(folder_.string(), header());
  log.add_keyframes({0, {made[0], made[1]}});
  log.add_window({0, 1, {made[2], made[3]}});
  EXPECT_EQ(log.window(), 1);
  ASSERT_EQ(so_far().keyframes.size(), 4u);
  EXPECT_EQ(so_far().keyframes[3].frame_index, made[3].frame_index);
  EXPECT_EQ(so_far().keyframes[3].points.size(), made[3].points.size());
  // A keyframe is marginalised: a kill between writing the two files duplicates none.
  log.add_keyframes({0, {made[2]}});
  ASSERT_EQ(so_far().keyframes.size(), 4u);
  log.add_window({0, 2, {made[3], made[4]}});
  ASSERT_EQ(so_far().keyframes.size(), 5u);
  EXPECT_EQ(so_far().keyframes[4].frame_index, made[4].frame_index);
  log.remove();
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(RecoveryLogs, WindowsBeforeAndAfterACorrectionAreNotMixed) {
  const auto& made = made_.run.keyframes;
  RecoveryLog log(folder_.string(), header());
  log.add_keyframes({0, {made[0]}});
  log.add_window({0, 1, {made[1]}});
  log.add_window({1, 2, {made[1], made[2]}});  // mapping is ahead: its marginalised keyframes come first
  EXPECT_EQ(log.window(), 1);
  EXPECT_EQ(so_far().keyframes.size(), 2u);
  log.add_keyframes({1, {made[0]}});
  EXPECT_EQ(so_far().keyframes.size(), 1u);
  log.add_window({1, 2, {made[1], made[2]}});
  EXPECT_EQ(so_far().keyframes.size(), 3u);
}

TEST_F(RecoveryLogs, AnIncompleteWindowCostsTheWindowOnly) {
  RecoveryLog log(folder_.string(), header());
  log.add_keyframes({0, {made_.run.keyframes[0]}});
  log.add_window({0, 1, {made_.run.keyframes[1]}});
  const std::string whole = content(folder_ / kRunWindow);
  for (size_t length = 0; length < whole.size(); length += whole.size() / 40) {
    write_file((folder_ / kRunWindow).string(), whole.substr(0, length));
    EXPECT_EQ(so_far().keyframes.size(), 1u) << length;
  }
}

TEST_F(RecoveryLogs, ATruncatedLogIsReadUpToItsEnd) {
  {
    RecoveryLog log(folder_.string(), header());
    write_all(&log);
  }
  const std::string all = bytes();
  size_t frames = 0;
  for (size_t length = 400; length < all.size(); length += all.size() / 150) {
    put(all.substr(0, length));
    const InterruptedRun back = read();
    EXPECT_GE(back.run.frames.size(), frames) << length;
    frames = back.run.frames.size();
    for (size_t i = 0; i < frames; ++i) EXPECT_EQ(back.run.frames[i].index, made_.run.frames[i].index);
  }
  EXPECT_GE(frames, made_.run.frames.size() - 1);
}

TEST_F(RecoveryLogs, DamageEndsItAndIsNeverReadAsAFrame) {
  {
    RecoveryLog log(folder_.string(), header());
    write_all(&log);
  }
  const std::string all = bytes();
  Random random(5);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::string damaged = all;
    damaged[size_t(random.below(int(all.size())))] ^= char(1 << random.below(8));
    put(damaged);
    try {
      const InterruptedRun back = read();
      for (size_t i = 0; i < back.run.frames.size(); ++i)
        ASSERT_EQ(frames_csv_row(back.run.frames[i], {}), frames_csv_row(made_.run.frames[i], {}));
    } catch (const InputError&) {
      ++refused;  // damaged header
    }
  }
  EXPECT_LT(refused, 30);
}

TEST_F(RecoveryLogs, OtherFilesAreRefused) {
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("holds no interrupted run"));
  put("a letter");
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("is incomplete, or was written by another version"));
  RecoveryLog log(folder_.string(), header());
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("its run is still in progress"));
  EXPECT_THAT(message_of([&] { RecoveryLog(folder_.string(), header()); }), HasSubstr("cannot be written"));
}

TEST_F(RecoveryLogs, AFullDiskEndsTheLogButNotTheRun) {
  fs::create_symlink("/dev/full", folder_ / kRecoveryLog);
  RecoveryLog log(folder_.string(), header());
  write_all(&log);
  EXPECT_TRUE(log.is_broken());
  EXPECT_FALSE(fs::exists(folder_ / kRecoveryLog)) << "its space is for the results";
}

}  // namespace
}  // namespace edgevo
