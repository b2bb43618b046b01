// A run that was killed, brought to its end.
#include "edgevo/results/cut_off_run.h"

#include <gmock/gmock.h>
#include <mrpt/containers/yaml.h>

#include <set>

#include "edgevo/files/output_folder.h"
#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/results/run_journal.h"
#include "edgevo/results/run_params.h"
#include "settle.h"
#include "written_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::content;
using test::lines_of;
using ::testing::HasSubstr;

SE3 at(double x) { return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0)}; }

// Frames 0 to 9 a unit apart, of which 2 and 6 are keyframes that have moved since, and grown farther apart.
CutOffRun moved_run() {
  CutOffRun cut_off;
  for (int i = 0; i < 10; ++i) {
    FrameRecord f;
    f.index = i;
    f.segment = 0;
    f.T_world_cam_live = at(i);
    cut_off.run.frames.push_back(f);
  }
  cut_off.run.keyframes.resize(2);
  cut_off.run.keyframes[0].frame_index = 2, cut_off.run.keyframes[0].T_world_cam = at(3);
  cut_off.run.keyframes[1].frame_index = 6, cut_off.run.keyframes[1].T_world_cam = at(9);
  return cut_off;
}

TEST(SettleFrames, MovesFramesAsTheirKeyframesMoved) {
  CutOffRun cut_off = moved_run();
  settle_frames(&cut_off);
  const auto x = [&](int i) { return cut_off.run.frames[size_t(i)].T_world_cam->translation().x(); };
  EXPECT_DOUBLE_EQ(x(2), 3);
  EXPECT_DOUBLE_EQ(x(4), 6) << "half way between the two, which are half as far apart again";
  EXPECT_DOUBLE_EQ(x(6), 9);
  EXPECT_DOUBLE_EQ(x(8), 12) << "behind the last keyframe the last ratio stands";
  EXPECT_DOUBLE_EQ(x(0), 0) << "before the first one the first";
  EXPECT_TRUE(cut_off.run.frames[6].is_keyframe);
  EXPECT_FALSE(cut_off.run.frames[5].is_keyframe);
  EXPECT_EQ(cut_off.run.frames[5].reference_keyframe, 0);
}

TEST(SettleFrames, KeepsLivePosesWhereNoKeyframeIsNear) {
  CutOffRun cut_off = moved_run();
  cut_off.run.frames[9].segment = 1;
  cut_off.run.frames[8].T_world_cam_live = std::nullopt;
  settle_frames(&cut_off);
  EXPECT_DOUBLE_EQ(cut_off.run.frames[9].T_world_cam->translation().x(), 9);
  EXPECT_FALSE(cut_off.run.frames[8].T_world_cam);
}

TEST(SettleFrames, ACorrectedCameraLeavesTheFirstPoseAtTheOrigin) {
  CutOffRun cut_off = moved_run();
  cut_off.camera_was_corrected = true;
  for (KeyframeRecord& k : cut_off.run.keyframes) k.T_world_cam = at(10) * k.T_world_cam;
  settle_frames(&cut_off);
  EXPECT_NEAR(cut_off.run.frames[0].T_world_cam->translation().norm(), 0, 1e-12);
  EXPECT_NEAR(cut_off.run.keyframes[1].T_world_cam.translation().x(), 9, 1e-12);
}

class CutOffRuns : public WrittenRun {
 protected:
  // The images and the journal of the first 40 frames, as a kill leaves them.
  void leave_half_a_run(const std::string& scale = "none") const {
    fs::create_directories(folder_);
    RunParams params;
    JournalHeader header;
    header.info.camera = made_.camera;
    header.info.source_kind = "synthetic";
    header.info.params_yaml = write_params([&](ParamVisitor& v) { params.visit(v); });
    header.scale = scale;
    RunJournal journal(folder_.string(), header);
    PlaybackWriter playback(folder_.string(), made_.camera);
    for (int i = 0; i < 40; ++i) {
      playback.add_frame(test::synthetic_frame(made_.camera, made_.run.frames[size_t(i)]));
      journal.add_frame(made_.run.frames[size_t(i)]);
    }
    SettledKeyframes settled;
    settled.keyframes.assign(made_.run.keyframes.begin(), made_.run.keyframes.begin() + 8);
    journal.add_keyframes(settled);
  }
};

TEST_F(CutOffRuns, EveryFileOfARunIsWritten) {
  write(folder_, made_.run, made_.camera);
  const std::vector<std::string> whole = names_in(folder_.string());
  fs::remove_all(folder_);
  leave_half_a_run();
  const edgevo::Run run = finish_cut_off_run(folder_.string());
  EXPECT_EQ(run.frames.size(), 40u);
  EXPECT_EQ(names_in(folder_.string()), whole) << "the same files, and no journal any more";
  for (const std::string& name : whole)
    if (name != "playback_Images") {
      EXPECT_GT(content(folder_ / name).size(), 100u) << name;
    }
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), 41u);
  const auto summary = mrpt::containers::yaml::FromFile((folder_ / "summary.yaml").string());
  EXPECT_TRUE(summary["source"]["interrupted"].as<bool>());
  EXPECT_THAT(summary["notes"]["cut_off"].as<std::string>(), HasSubstr("after 40 frames"));
  EXPECT_EQ(summary["trajectory"]["keyframes"].as<int>(), 8);
  EXPECT_THAT(message_of([&] { finish_cut_off_run(folder_.string()); }),
              HasSubstr("no run was cut off here"));
}

TEST_F(CutOffRuns, AGivenScaleIsApplied) {
  leave_half_a_run("factor=3");
  const edgevo::Run run = finish_cut_off_run(folder_.string());
  EXPECT_TRUE(run.is_metric());
  EXPECT_NEAR(run.frames[39].T_world_cam->translation().z() - run.frames[38].T_world_cam->translation().z(),
              0.6, 0.01);
}

TEST_F(CutOffRuns, TheNextRunMayTakeItsPlace) {
  leave_half_a_run();
  EXPECT_THAT(message_of([&] { write(folder_, made_.run, made_.camera); }), HasSubstr("edgevo finish"));
  finish_cut_off_run(folder_.string());
  write(folder_, made_.run, made_.camera);
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), 46u);
}

}  // namespace
}  // namespace edgevo
