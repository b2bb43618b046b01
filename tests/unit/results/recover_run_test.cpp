// SPDX-License-Identifier: BSD-3-Clause
// Recovery of a run that was killed.
#include "edgevo/results/recover_run.h"

#include <gmock/gmock.h>
#include <mrpt/containers/yaml.h>

#include "edgevo/core/output_file.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "edgevo/results/recovery_log.h"
#include "edgevo/results/run_params.h"
#include "recovered_run.h"
#include "support/made_events.h"
#include "written_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::content;
using test::lines_of;
using ::testing::HasSubstr;

class InterruptedRuns : public WrittenRun {
 protected:
  // Images and recovery log of the first frames, as a killed program leaves them.
  void leave_a_run(const std::string& scale = "none", size_t frames = 40) const {
    leave(events_, scale, frames);
  }
  void leave(const test::MadeEvents& events, const std::string& scale, size_t frames) const {
    fs::create_directories(folder_);
    RecoveryLog log(folder_.string(), header(scale));
    PlaybackWriter playback(folder_.string(), made_.camera);
    for (size_t i = 0; i < frames; ++i) {
      playback.add_frame(test::synthetic_frame(made_.camera, made_.run.frames[i]));
      log.add(events.frames()[i]);
    }
  }

  RecoveryHeader header(const std::string& scale = "none") const {
    RunParams params;
    RecoveryHeader header;
    header.info.camera = made_.camera;
    header.info.source_kind = "synthetic";
    header.info.params_yaml = write_params([&](ParamVisitor& v) { params.visit(v); });
    header.scale = scale;
    return header;
  }

  const test::MadeEvents events_{made_};
};

TEST_F(InterruptedRuns, ARunKeepsItsEventsOnDiskUntilItsFilesAreWritten) {
  const auto log = std::make_shared<MapLog>();
  RunOutputs outputs(folder_.string(), made_.camera, {});
  outputs.keep_recovery_log(header(), log);
  RunBuilder builder(made_.run.pinhole);
  for (size_t i = 0; i < made_.run.frames.size(); ++i) {
    for (const auto& event : events_.frames()[i]) {
      log->append(*event);
      builder.apply(*event);
    }
    ASSERT_TRUE(outputs.add_frame(test::synthetic_frame(made_.camera, made_.run.frames[i])));
    outputs.add_record(made_.run.frames[i]);
    EXPECT_EQ(log->kept(), 0u);
  }
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), made_.run.frames.size() + 1);
  const std::string killed = temp_ / "killed";
  fs::copy(folder_, killed, fs::copy_options::recursive);
  const edgevo::Run run = builder.finish();
  test::expect_same_run(recover_run(killed).run, run);
  outputs.finish(run, {});
  EXPECT_FALSE(fs::exists(folder_ / kRecoveryLog));
}

TEST_F(InterruptedRuns, AllFilesOfARunAreWritten) {
  write(folder_, made_.run, made_.camera);
  const std::vector<std::string> whole = names_in(folder_.string());
  fs::remove_all(folder_);
  leave_a_run();
  const edgevo::Run run = recover_run(folder_.string()).run;
  EXPECT_EQ(run.frames.size(), 40u);
  EXPECT_EQ(names_in(folder_.string()), whole) << "the same files, without the recovery log";
  for (const std::string& name : whole)
    if (name != "playback_Images") {
      EXPECT_GT(content(folder_ / name).size(), 100u) << name;
    }
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), 41u);
  const auto summary = mrpt::containers::yaml::FromFile((folder_ / "summary.yaml").string());
  EXPECT_TRUE(summary["source"]["interrupted"].as<bool>());
  EXPECT_THAT(summary["notes"]["cut_off"].as<std::string>(), HasSubstr("after 40 frames"));
  EXPECT_EQ(summary["trajectory"]["keyframes"].as<int>(), 12);
  EXPECT_GT(summary["map"]["lines"].as<int>(), 0) << "those that were finished";
  EXPECT_THAT(message_of([&] { recover_run(folder_.string()); }), HasSubstr("holds no interrupted run"));
}

TEST_F(InterruptedRuns, ThePastMovesAsInARunThatEndedThere) {
  const size_t frames = test::MadeEvents::kMovedAfter + 1;
  leave_a_run("none", frames);
  std::vector<MapEvent> events;
  for (size_t i = 0; i < frames; ++i)
    for (const auto& event : events_.frames()[i]) events.push_back(*event);
  test::expect_same_run(recover_run(folder_.string()).run, test::run_from(made_.run.pinhole, events));
}

TEST_F(InterruptedRuns, AGivenScaleIsApplied) {
  leave_a_run("factor=3");
  const edgevo::Run run = recover_run(folder_.string()).run;
  EXPECT_TRUE(run.is_metric());
  EXPECT_NEAR(run.frames[39].T_world_cam->translation().z() - run.frames[38].T_world_cam->translation().z(),
              0.6, 0.01);
}

TEST_F(InterruptedRuns, TheResolutionOfTheirMapsCanBeChosen) {
  leave_a_run();
  RecoveryOptions options;
  options.resolution = 0.5;
  recover_run(folder_.string(), options);
  EXPECT_THAT(content(folder_ / "grid.yaml"), HasSubstr("resolution: 0.5"));
}

TEST_F(InterruptedRuns, PointsOfDoubtfulKeyframesAreIncludedOnRequest) {
  test::SyntheticRun made = made_;
  made.run.keyframes.front().is_doubtful = true;
  const auto points = [&](bool include) {
    fs::remove_all(folder_);
    leave(test::MadeEvents(made), "none", 40);
    RecoveryOptions options;
    options.include_doubtful = include;
    recover_run(folder_.string(), options);
    EXPECT_EQ(fs::exists(folder_ / "edges_doubtful.ply"), !include);
    return read_edge_ply((folder_ / "edges.ply").string()).keyframes[0].points.size();
  };
  EXPECT_EQ(points(false), 0u);
  EXPECT_GT(points(true), 0u);
}

TEST_F(InterruptedRuns, TheNextRunMayReplaceIt) {
  leave_a_run();
  EXPECT_THAT(message_of([&] { write(folder_, made_.run, made_.camera); }), HasSubstr("edgevo finish"));
  recover_run(folder_.string());
  write(folder_, made_.run, made_.camera);
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), 46u);
}

// Not cut off, as a killed program leaves it, but damaged on the disk.
TEST_F(InterruptedRuns, ADamagedLogIsReportedAndKept) {
  leave_a_run();
  const std::string log = (folder_ / kRecoveryLog).string(), whole = content(log);
  for (const double share : {0.3, 0.5, 0.7}) {
    std::string bytes = whole;
    bytes[size_t(share * double(bytes.size()))] ^= 1;
    write_file(log, bytes);
    const RecoveredRun recovered = recover_run(folder_.string());
    EXPECT_TRUE(recovered.is_damaged);
    EXPECT_LT(recovered.run.frames.size(), 40u);
    EXPECT_NEAR(double(recovered.run.frames.size()) + recovered.frames_lost, 40, 1)
        << "one may be the damage";
    EXPECT_EQ(content(log), bytes) << "it may still be needed";
    EXPECT_THAT(content(folder_ / "summary.yaml"), HasSubstr("could not be recovered"));
  }
  write_file(log, whole.substr(0, whole.size() / 2));
  const RecoveredRun cut_off = recover_run(folder_.string());
  EXPECT_FALSE(cut_off.is_damaged);
  EXPECT_FALSE(fs::exists(log));
}

}  // namespace
}  // namespace edgevo
