// SPDX-License-Identifier: BSD-3-Clause
// The recovery log is read back completely up to where the file ends.
#include "edgevo/results/recovery_log.h"

#include <gmock/gmock.h>

#include "edgevo/map/run_builder.h"
#include "growing_file.h"
#include "recovery_logs.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::content;
using test::FrameEvents;
using test::MadeEvents;
using ::testing::HasSubstr;

constexpr size_t kBeforeMove = MadeEvents::kMovedAfter, kAfterMove = kBeforeMove + 1;

// ---- whole runs ----

TEST_F(RecoveryLogs, GivesTheRunThatItsEventsMake) {
  for (const size_t frames :
       {size_t(3), size_t(5), size_t(18), size_t(22), kBeforeMove, kAfterMove, all_frames()}) {
    write_frames(frames);
    EXPECT_EQ(recovered().frames.size(), frames);
    test::expect_same_run(recovered(), direct(frames));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
}

TEST_F(RecoveryLogs, HoldsPosesFoundLaterByABootstrap) {
  write_frames(MadeEvents::kFirstPose);
  EXPECT_FALSE(recovered().frames[2].T_world_cam_live);
  write_frames(MadeEvents::kFirstPose + 1);
  EXPECT_TRUE(recovered().frames[2].T_world_cam_live);
  EXPECT_EQ(recovered().frames.size(), size_t(MadeEvents::kFirstPose + 1));
}

TEST_F(RecoveryLogs, FollowsAPastThatMovesWithoutTheCamera) {
  const auto length = [](const edgevo::Run& run) {  // from keyframe to keyframe, behind the window
    return (run.keyframes[8].T_world_cam.translation() - run.keyframes[7].T_world_cam.translation()).norm();
  };
  write_frames(kBeforeMove);
  const edgevo::Run before = recovered();
  write_frames(kAfterMove);
  const edgevo::Run after = recovered();
  EXPECT_NEAR(length(after), MadeEvents::kGrowth * length(before), 1e-9);
  EXPECT_NEAR(double(after.keyframes[8].points[0].idepth),
              double(before.keyframes[8].points[0].idepth) / MadeEvents::kGrowth, 1e-6);
  EXPECT_NEAR(after.keyframes[0].points[0].idepth, before.keyframes[0].points[0].idepth, 1e-9)
      << "other segment";
  expect_same(*after.frames[41].T_world_cam_live, *before.frames[41].T_world_cam_live);
}

TEST_F(RecoveryLogs, AKillRightAfterAMoveCostsTheWindow) {
  write_frames(kBeforeMove);
  const std::string window = content(folder_ / kRunWindow);
  const size_t keyframes = recovered().keyframes.size();
  write_frames(kAfterMove);
  write_file((folder_ / kRunWindow).string(), window);
  const edgevo::Run back = recovered();
  EXPECT_EQ(back.keyframes.size() + MadeEvents::kWindow, keyframes + 1) << "one more was marginalised";
  const FrameRecord& newest = back.frames.back();
  ASSERT_TRUE(newest.T_world_cam) << "it has its live pose";
  EXPECT_EQ(newest.reference_keyframe, -1);
}

TEST_F(RecoveryLogs, AWindowFromBeforeAKeyframeWasMarginalisedDuplicatesNone) {
  write_frames(13);  // with keyframe 12
  const std::string window = content(folder_ / kRunWindow);
  write_frames(16);  // with keyframe 15
  const size_t keyframes = recovered().keyframes.size();
  write_file((folder_ / kRunWindow).string(), window);
  EXPECT_EQ(recovered().keyframes.size(), keyframes - 1) << "the newest";
}

TEST_F(RecoveryLogs, AWindowOfAClosedMapAddsNothing) {
  write_frames(20);
  const std::string window = content(folder_ / kRunWindow);
  const size_t keyframes = recovered().keyframes.size();
  write_frames(21);  // lost: the map is closed
  EXPECT_EQ(recovered().keyframes.size(), keyframes);
  write_file((folder_ / kRunWindow).string(), window);
  EXPECT_EQ(recovered().keyframes.size(), keyframes);
}

TEST_F(RecoveryLogs, TheWindowOfAnotherRunIsGone) {
  write_frames(20);
  ASSERT_TRUE(fs::exists(folder_ / kRunWindow));
  const RecoveryLog next(folder_.string(), header());
  EXPECT_FALSE(fs::exists(folder_ / kRunWindow));
}

TEST_F(RecoveryLogs, AnIncompleteWindowCostsTheWindowOnly) {
  write_frames(19);
  const std::string whole = content(folder_ / kRunWindow);
  const size_t keyframes = recovered().keyframes.size();
  for (size_t length = 0; length < whole.size(); length += whole.size() / 40) {
    write_file((folder_ / kRunWindow).string(), whole.substr(0, length));
    EXPECT_EQ(recovered().keyframes.size(), keyframes - MadeEvents::kWindow) << length;
  }
}

// ---- damage ----

// The contents of the events, with their kinds.
std::vector<std::string> contents(const std::vector<MapEvent>& events) {
  std::vector<std::string> all;
  for (const MapEvent& event : events) all.push_back(char(kind_of(event)) + bytes_of(event));
  return all;
}

class SmallRecoveryLogs : public RecoveryLogs {
 protected:
  SmallRecoveryLogs() {
    RecoveryLog log(folder_.string(), header());
    for (const FrameEvents& events : small_.frames()) log.add(events);
    fs::remove(folder_ / kRunWindow);
  }
  const MadeEvents small_{test::synthetic_run(45, 4)};
};

TEST_F(SmallRecoveryLogs, ATruncatedLogIsReadUpToItsEnd) {
  const std::string all = bytes();
  const std::vector<std::string> written = contents(read());
  size_t before = 0;
  for (size_t length = 600; length < all.size(); length += 17) {
    put(all.substr(0, length));
    const std::vector<MapEvent> events = read();
    const std::vector<std::string> back = contents(events);
    ASSERT_GE(back.size(), before) << length;
    ASSERT_LE(back.size(), written.size());
    ASSERT_TRUE(std::equal(back.begin(), back.end(), written.begin())) << length;
    if (back.size() != before) test::run_from(made_.run.pinhole, events);
    before = back.size();
  }
  EXPECT_GE(before, written.size() - 1);
}

TEST_F(SmallRecoveryLogs, DamageEndsItAndIsNeverReadAsAnEvent) {
  const std::string all = bytes();
  const std::vector<std::string> written = contents(read());
  Random random(5);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::string damaged = all;
    damaged[size_t(random.below(int(all.size())))] ^= char(1 << random.below(8));
    put(damaged);
    try {
      const std::vector<std::string> back = contents(read());
      ASSERT_LT(back.size(), written.size());
      ASSERT_TRUE(std::equal(back.begin(), back.end(), written.begin()));
    } catch (const InputError&) {
      ++refused;  // damaged header
    }
  }
  EXPECT_LT(refused, 30);
}

TEST_F(RecoveryLogs, OtherFilesAreRefused) {
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("holds no interrupted run"));
  put("a letter");
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("is incomplete or no recovery log"));
  for (const char* other : {"edgevo run journal 1\n", "edgevo recovery log 2\n"}) {
    put(other + std::string(100, 'x'));
    EXPECT_THAT(
        message_of([&] { read(); }),
        HasSubstr("was written by another version of edgevo; finish the run with that version, or run the "
                  "sequence again with --force"));
  }
  RecoveryLog log(folder_.string(), header());
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("its run is still in progress"));
  EXPECT_THAT(message_of([&] { RecoveryLog(folder_.string(), header()); }), HasSubstr("cannot be written"));
}

TEST_F(RecoveryLogs, AFullDiskEndsTheLogButNotTheRun) {
  fs::create_symlink("/dev/full", folder_ / kRecoveryLog);
  RecoveryLog log(folder_.string(), header());
  for (const FrameEvents& events : events_.frames()) log.add(events);
  EXPECT_TRUE(log.is_broken());
  EXPECT_TRUE(fs::is_empty(folder_)) << "its space is for the results";
}

TEST_F(RecoveryLogs, RemovesItsFiles) {
  RecoveryLog log(folder_.string(), header());
  for (size_t i = 0; i < kBeforeMove; ++i) log.add(events_.frames()[i]);
  EXPECT_FALSE(fs::is_empty(folder_));
  log.remove();
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace edgevo
