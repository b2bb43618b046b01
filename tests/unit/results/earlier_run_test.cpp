// SPDX-License-Identifier: BSD-3-Clause
// Handling of files that are in the output folder before a run.
#include <gmock/gmock.h>

#include <algorithm>

#include "earlier_run.h"
#include "edgevo/core/output_file.h"
#include "edgevo/files/output_folder.h"
#include "growing_file.h"
#include "written_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::content;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class EarlierRuns : public WrittenRun {
 protected:
  // A metric run with a vehicle, which has two more files.
  edgevo::Run metric_run() const {
    edgevo::Run run = made_.run;
    run.T_vehicle_cam = SE3();
    run.scale_source = "odometry";
    run.scale.frames.resize(run.frames.size());
    return run;
  }
  edgevo::Run run_without_poses() const {
    edgevo::Run run = made_.run;
    for (FrameRecord& f : run.frames) f.T_world_cam = f.T_world_cam_live = std::nullopt;
    run.keyframes.clear();
    return run;
  }
  std::string trajectory(const char* where = "") const {
    return content(folder_ / where / "trajectory_tum.txt");
  }
};

TEST_F(EarlierRuns, ARunWithoutFramesChangesNothing) {
  write(folder_, made_.run, made_.camera);
  const std::vector<std::string> before = names_in(folder_.string());
  const std::string poses = trajectory();
  { RunOutputs begun_and_dropped(folder_.string(), made_.camera, {}); }
  EXPECT_EQ(names_in(folder_.string()), before);
  EXPECT_EQ(trajectory(), poses);
  { RunOutputs nothing_there((temp_ / "new"), made_.camera, {}); }
  EXPECT_FALSE(fs::exists(temp_ / "new"));
}

TEST_F(EarlierRuns, IsRemovedByTheNextRun) {
  write(folder_, metric_run(), made_.camera);
  ASSERT_TRUE(fs::exists(folder_ / "scale.csv"));
  write_file((folder_ / "my_notes.txt").string(), "by hand");
  edgevo::Run shorter = made_.run;
  shorter.frames.resize(10);
  write(folder_, shorter, made_.camera);
  for (const char* gone :
       {"scale.csv", "trajectory_vehicle_tum.txt", "playback_Images/frame_000020.png", kEarlierRun})
    EXPECT_FALSE(fs::exists(folder_ / gone)) << gone;
  EXPECT_EQ(content(folder_ / "my_notes.txt"), "by hand");
}

TEST_F(EarlierRuns, IsKeptIfTheNextRunHasNoPose) {
  write(folder_, made_.run, made_.camera);
  const std::string poses = trajectory();
  for (int again = 0; again < 2; ++again) {
    write(folder_, run_without_poses(), made_.camera);
    EXPECT_NE(trajectory(), poses);
    EXPECT_EQ(trajectory(kEarlierRun), poses);
  }
  write(folder_, made_.run, made_.camera);
  EXPECT_EQ(trajectory(), poses);
  EXPECT_FALSE(fs::exists(folder_ / kEarlierRun));
}

TEST_F(EarlierRuns, AFolderWithOtherFilesIsRefused) {
  fs::create_directories(folder_);
  write_file((folder_ / "thesis.tex").string(), "years");
  write_file((folder_ / "summary.yaml").string(), "mine");
  EXPECT_THAT(message_of([&] { write(folder_, made_.run, made_.camera); }),
              HasSubstr("contains other files already (summary.yaml, ...); give another -o, or --force"));
  EXPECT_THAT(names_in(folder_.string()), ElementsAre("summary.yaml", "thesis.tex"));
  OutputOptions options;
  options.force = true;
  RunOutputs forced(folder_.string(), made_.camera, {}, options);
  forced.finish(made_.run, {});
  EXPECT_EQ(content(folder_ / "thesis.tex"), "years");
}

TEST_F(EarlierRuns, AnInterruptedRunIsNotOverwritten) {
  fs::create_directories(folder_);
  write_file((folder_ / kRecoveryLog).string(), "what it had");
  EXPECT_THAT(
      message_of([&] { write(folder_, made_.run, made_.camera); }),
      HasSubstr("was interrupted before its results were written; `edgevo finish " + folder_.string() + "`"));
  EXPECT_EQ(content(folder_ / kRecoveryLog), "what it had");
}

TEST_F(EarlierRuns, AFolderInUseIsRefused) {
  fs::create_directories(folder_);
  GrowingFile log;
  ASSERT_TRUE(log.open((folder_ / kRecoveryLog).string()));
  for (const bool force : {false, true})
    EXPECT_THAT(message_of([&] { EarlierRun(folder_.string(), force); }),
                HasSubstr("another run is writing there"));
}

}  // namespace
}  // namespace edgevo
