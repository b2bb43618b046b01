// SPDX-License-Identifier: BSD-3-Clause
// Recovery of a run that was killed.
#include "edgevo/results/recover_run.h"

#include <gmock/gmock.h>
#include <mrpt/containers/yaml.h>

#include <set>

#include "edgevo/files/output_folder.h"
#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/results/recovery_log.h"
#include "edgevo/results/run_params.h"
#include "propagate_keyframe_poses.h"
#include "written_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::content;
using test::lines_of;
using ::testing::HasSubstr;

SE3 at(double x) { return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0)}; }

// Frames 0 to 9, one unit apart. Frames 2 and 6 are keyframes that have moved and are now farther apart.
InterruptedRun moved_run() {
  InterruptedRun interrupted;
  for (int i = 0; i < 10; ++i) {
    FrameRecord f;
    f.index = i;
    f.segment = 0;
    f.T_world_cam_live = at(i);
    interrupted.run.frames.push_back(f);
  }
  interrupted.run.keyframes.resize(2);
  interrupted.run.keyframes[0].frame_index = 2, interrupted.run.keyframes[0].T_world_cam = at(3);
  interrupted.run.keyframes[1].frame_index = 6, interrupted.run.keyframes[1].T_world_cam = at(9);
  return interrupted;
}

TEST(PropagateKeyframePoses, MovesFramesWithTheirKeyframes) {
  InterruptedRun interrupted = moved_run();
  propagate_keyframe_poses(&interrupted);
  const auto x = [&](int i) { return interrupted.run.frames[size_t(i)].T_world_cam->translation().x(); };
  EXPECT_DOUBLE_EQ(x(2), 3);
  EXPECT_DOUBLE_EQ(x(4), 6) << "half way between the two, which are 1.5 times as far apart";
  EXPECT_DOUBLE_EQ(x(6), 9);
  EXPECT_DOUBLE_EQ(x(8), 12) << "after the last keyframe: the last ratio";
  EXPECT_DOUBLE_EQ(x(0), 0) << "before the first keyframe: the first ratio";
  EXPECT_TRUE(interrupted.run.frames[6].is_keyframe);
  EXPECT_FALSE(interrupted.run.frames[5].is_keyframe);
  EXPECT_EQ(interrupted.run.frames[5].reference_keyframe, 0);
}

TEST(PropagateKeyframePoses, KeepsLivePosesOfASegmentWithoutKeyframes) {
  InterruptedRun interrupted = moved_run();
  interrupted.run.frames[9].segment = 1;
  interrupted.run.frames[8].T_world_cam_live = std::nullopt;
  propagate_keyframe_poses(&interrupted);
  EXPECT_DOUBLE_EQ(interrupted.run.frames[9].T_world_cam->translation().x(), 9);
  EXPECT_FALSE(interrupted.run.frames[8].T_world_cam);
}

TEST(PropagateKeyframePoses, ACorrectedCameraLeavesTheFirstPoseAtTheOrigin) {
  InterruptedRun interrupted = moved_run();
  interrupted.camera_was_corrected = true;
  for (KeyframeRecord& k : interrupted.run.keyframes) k.T_world_cam = at(10) * k.T_world_cam;
  propagate_keyframe_poses(&interrupted);
  EXPECT_NEAR(interrupted.run.frames[0].T_world_cam->translation().norm(), 0, 1e-12);
  EXPECT_NEAR(interrupted.run.keyframes[1].T_world_cam.translation().x(), 9, 1e-12);
}

class InterruptedRuns : public WrittenRun {
 protected:
  // Images and recovery log of the first 40 frames, as a killed program leaves them.
  void leave_half_a_run(const std::string& scale = "none") const {
    fs::create_directories(folder_);
    RunParams params;
    RecoveryHeader header;
    header.info.camera = made_.camera;
    header.info.source_kind = "synthetic";
    header.info.params_yaml = write_params([&](ParamVisitor& v) { params.visit(v); });
    header.scale = scale;
    RecoveryLog log(folder_.string(), header);
    PlaybackWriter playback(folder_.string(), made_.camera);
    for (int i = 0; i < 40; ++i) {
      playback.add_frame(test::synthetic_frame(made_.camera, made_.run.frames[size_t(i)]));
      log.add_frame(made_.run.frames[size_t(i)]);
    }
    MarginalisedKeyframes marginalised;
    marginalised.keyframes.assign(made_.run.keyframes.begin(), made_.run.keyframes.begin() + 8);
    log.add_keyframes(marginalised);
  }
};

TEST_F(InterruptedRuns, AllFilesOfARunAreWritten) {
  write(folder_, made_.run, made_.camera);
  const std::vector<std::string> whole = names_in(folder_.string());
  fs::remove_all(folder_);
  leave_half_a_run();
  const edgevo::Run run = recover_run(folder_.string());
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
  EXPECT_EQ(summary["trajectory"]["keyframes"].as<int>(), 8);
  EXPECT_THAT(message_of([&] { recover_run(folder_.string()); }), HasSubstr("holds no interrupted run"));
}

TEST_F(InterruptedRuns, AGivenScaleIsApplied) {
  leave_half_a_run("factor=3");
  const edgevo::Run run = recover_run(folder_.string());
  EXPECT_TRUE(run.is_metric());
  EXPECT_NEAR(run.frames[39].T_world_cam->translation().z() - run.frames[38].T_world_cam->translation().z(),
              0.6, 0.01);
}

TEST_F(InterruptedRuns, TheNextRunMayReplaceIt) {
  leave_half_a_run();
  EXPECT_THAT(message_of([&] { write(folder_, made_.run, made_.camera); }), HasSubstr("edgevo finish"));
  recover_run(folder_.string());
  write(folder_, made_.run, made_.camera);
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), 46u);
}

}  // namespace
}  // namespace edgevo
