// SPDX-License-Identifier: BSD-3-Clause
// A rawlog with the mount of the camera: all outputs for robots refer to the vehicle.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <algorithm>

#include <map>

#include "edgevo/datasets/open_source.h"
#include "edgevo/evaluation/trajectory.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/mrpt_bridge/rawlog_import.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"
#include "edgevo/mrpt_bridge/rawlog_source.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/results/run_text.h"
#include "edgevo/scale/given_scale.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

constexpr int kFrames = 60;

// 0.9 m ahead of the vehicle's origin, 0.4 m to its right, 1.2 m up; turned 40 degrees to the left and 15
// down.
SE3 mount() {
  const Eigen::Quaterniond turn =
      Eigen::AngleAxisd(0.70, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.26, Eigen::Vector3d::UnitY());
  return SE3(turn, {0.9, -0.4, 1.2}) * T_vehicle_cam_forward();
}

// The rendered desk, seen by a camera with this mount.
class MountedDesk : public ImageSource {
 public:
  MountedDesk() {
    SourceOptions options;
    options.path = EDGEVO_TEST_SCENES "/desk";
    options.last = kFrames;
    desk_ = open_source(options);
  }
  const Camera& camera() const override { return desk_->camera(); }
  std::optional<int> size() const override { return desk_->size(); }
  std::string kind() const override { return desk_->kind(); }
  std::optional<Frame> next() override { return desk_->next(); }
  std::optional<SE3> T_vehicle_cam() const override { return mount(); }

 private:
  std::unique_ptr<ImageSource> desk_;
};

// Poses of the vehicle by frame time, from the observations of a rawlog.
std::map<int64_t, SE3> robot_poses(const std::string& rawlog) {
  std::map<int64_t, SE3> poses;
  RawlogReader reader(rawlog);
  while (const auto observation = reader.next())
    if (const auto pose = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(observation))
      poses[from_mrpt(pose->timestamp).ticks] = from_mrpt(pose->pose.mean);
  return poses;
}

class Mount : public ::testing::Test {
 protected:
  // Writes a rawlog, reads it and runs on it, once for all tests.
  static void SetUpTestSuite() {
    folder_ = new test::TempFolder();
    truth_ = new std::vector<SE3>();
    for (const StampedPose& pose : read_trajectory(EDGEVO_TEST_SCENES "/desk/groundtruth_tum.txt").poses)
      truth_->push_back(pose.T_world_cam);
    truth_->resize(kFrames);
    MountedDesk desk;
    import_rawlog(desk, *folder_ / "desk.rawlog");
    const auto source = open_rawlog({*folder_ / "desk.rawlog", "", {}});
    Odometry odometry(source->camera(), {}, {});
    PlaybackWriter playback(folder_->path(), source->camera());
    while (const auto frame = source->next()) {
      odometry.process(*frame);
      playback.add_frame(*frame);
    }
    run_ = new edgevo::Run(odometry.finish());
    run_->T_vehicle_cam = source->T_vehicle_cam();
    scale_run(way(*truth_) / way_of_run(), "test", run_);
    playback.finish(*run_, {});
  }
  static void TearDownTestSuite() {
    delete run_;
    delete truth_;
    delete folder_;
  }

  static double way(const std::vector<SE3>& poses) {
    double length = 0;
    for (size_t i = 1; i < poses.size(); ++i)
      length += (poses[i].translation() - poses[i - 1].translation()).norm();
    return length;
  }
  static double way_of_run() {
    std::vector<SE3> poses;
    for (const FrameRecord& f : run_->frames) poses.push_back(f.T_world_cam.value());
    return way(poses);
  }
  // V = C (+) rel (+) inverse(C), from the poses that the scene was rendered with.
  static SE3 true_vehicle(int frame, const SE3& C) {
    return C * truth_->front().inverse() * (*truth_)[size_t(frame)] * C.inverse();
  }

  static test::TempFolder* folder_;
  static std::vector<SE3>* truth_;
  static edgevo::Run* run_;
};

test::TempFolder* Mount::folder_ = nullptr;
std::vector<SE3>* Mount::truth_ = nullptr;
edgevo::Run* Mount::run_ = nullptr;

TEST_F(Mount, ComesThroughTheRawlog) {
  ASSERT_TRUE(run_->T_vehicle_cam);
  EXPECT_LT((run_->T_vehicle_cam->inverse() * mount()).log().norm(), 1e-9);
}

TEST_F(Mount, PlaybackHoldsThePosesOfTheVehicle) {
  const auto poses = robot_poses(*folder_ / "playback.rawlog");
  ASSERT_EQ(poses.size(), size_t(kFrames));
  double without_the_mount = 0;
  for (const FrameRecord& frame : run_->frames) {
    const SE3 error = true_vehicle(frame.index, mount()).inverse() * poses.at(frame.time.ticks);
    EXPECT_LT(error.translation().norm(), 0.01) << frame.index;
    EXPECT_LT(error.angle(), 0.005) << frame.index;
    const SE3 naive =
        true_vehicle(frame.index, T_vehicle_cam_forward()).inverse() * poses.at(frame.time.ticks);
    without_the_mount = std::max(without_the_mount, naive.translation().norm());
  }
  EXPECT_GT(without_the_mount, 0.1);  // the mount matters in this motion
}

TEST_F(Mount, PlaybackKeepsTheMountForTheNextRun) {
  const auto again = open_rawlog({*folder_ / "playback.rawlog", "", {}});
  ASSERT_TRUE(again->T_vehicle_cam());
  EXPECT_LT((again->T_vehicle_cam()->inverse() * mount()).log().norm(), 1e-9);
}

TEST_F(Mount, TheTextFileHoldsThemToo) {
  const auto poses = robot_poses(*folder_ / "playback.rawlog");
  const Trajectory read = parse_trajectory(trajectory_vehicle_tum(*run_), "vehicle");
  ASSERT_EQ(read.poses.size(), poses.size());
  for (const auto& pose : read.poses)
    EXPECT_LT((pose.T_world_cam.inverse() * poses.at(pose.time.ticks)).log().norm(), 1e-6);
}

// The lever arm is in metres and is ignored where the unit of the run is arbitrary.
TEST_F(Mount, WithoutScaleTheRotationOfTheMountCounts) {
  edgevo::Run unscaled = *run_;
  unscaled.scale_source = "none";
  const SE3 C(mount().rotation(), Eigen::Vector3d::Zero());
  const SE3 expected = C * *run_->frames.back().T_world_cam * C.inverse();
  const std::string text = trajectory_vehicle_tum(unscaled);
  const Trajectory read = parse_trajectory(text, "vehicle");
  EXPECT_LT((read.poses.back().T_world_cam.inverse() * expected).log().norm(), 1e-6);
  EXPECT_NE(text.find("is left out"), std::string::npos);
}

}  // namespace
}  // namespace edgevo
