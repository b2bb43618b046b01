// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/playback_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>

#include <fstream>
#include <numeric>
#include <sstream>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/mrpt_bridge/playback_pose.h"
#include "playback_test_run.h"

namespace edgevo {
namespace {

using test::small_run;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PlaybackFiles : public test::FolderTest {
 protected:
  static Frame frame(int index) {
    Frame f;
    f.index = index;
    f.image = {64, 48, std::vector<uint8_t>(64 * 48)};
    std::iota(f.image.pixels.begin(), f.image.pixels.end(), uint8_t(index));
    return f;
  }
  static Camera camera() { return {{300, 300, 32, 24, 64, 48}, {-0.1, 0.01, 0, 0, 0}}; }

  // The whole run of small_run(), images included.
  void write(const edgevo::Run& run) const {
    PlaybackWriter writer(folder_.string(), camera());
    for (const FrameRecord& f : run.frames) writer.add_frame(frame(f.index));
    writer.finish(run, PointFilter());
  }
  std::vector<mrpt::obs::CObservation::Ptr> read() const {
    mrpt::io::CFileGZInputStream file;
    EXPECT_TRUE(file.open(path("playback.rawlog")));
    auto archive = mrpt::serialization::archiveFrom(file);
    std::vector<mrpt::obs::CObservation::Ptr> all;
    try {
      for (;;) all.push_back(archive.ReadObject<mrpt::obs::CObservation>());
    } catch (const mrpt::serialization::CExceptionEOF&) {
    }
    return all;
  }
  template <class T>
  std::vector<std::shared_ptr<T>> read_all() const {
    std::vector<std::shared_ptr<T>> some;
    for (const auto& obs : read())
      if (auto typed = std::dynamic_pointer_cast<T>(obs)) some.push_back(typed);
    return some;
  }
  std::string bytes(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
};

TEST_F(PlaybackFiles, HoldsEveryImagePoseAndKeyframeInTimeOrder) {
  const edgevo::Run run = small_run();
  write(run);
  const auto all = read();
  ASSERT_EQ(all.size(), 8u + 7 + 7 + 3 + 1);
  for (size_t i = 1; i < all.size(); ++i) EXPECT_LE(all[i - 1]->timestamp, all[i]->timestamp);
  EXPECT_EQ(from_mrpt(all.front()->timestamp), run.frames.front().time);
  EXPECT_EQ(from_mrpt(all.back()->timestamp), run.frames.back().time);
}

TEST_F(PlaybackFiles, APoseThatIsNotToBeTrustedHasACommentThatSaysWhy) {
  edgevo::Run run = small_run();
  run.frames[4].p_right = 0.05, run.frames[4].note = "corners contradict the scale";
  write(run);
  const auto comments = read_all<mrpt::obs::CObservationComment>();
  ASSERT_EQ(comments.size(), 2u) << "a lost frame has no pose";
  EXPECT_EQ(comments[1]->text,
            "EDGE_VO: frame 4 is not to be trusted (p_right 0.050, TRACKING): corners contradict the scale");
  EXPECT_EQ(from_mrpt(comments[1]->timestamp), run.frames[4].time);
}

TEST_F(PlaybackFiles, ImagesAreByReferenceAndLossless) {
  write(small_run());
  const auto images = read_all<mrpt::obs::CObservationImage>();
  ASSERT_EQ(images.size(), 8u);
  EXPECT_EQ(images[2]->sensorLabel, "CAM0");
  ASSERT_TRUE(images[2]->image.isExternallyStored());
  EXPECT_EQ(images[2]->image.getExternalStorageFile(), "frame_000002.png");
  EXPECT_EQ(read_gray_image(path("playback_Images/frame_000002.png")).pixels, frame(2).image.pixels);
  EXPECT_EQ(images[2]->cameraParams.fx(), 300);
  EXPECT_EQ(images[2]->cameraParams.k1(), -0.1);
}

TEST_F(PlaybackFiles, PosesAreTheVehicles) {
  const edgevo::Run run = small_run();
  write(run);
  const auto poses = read_all<mrpt::obs::CObservationRobotPose>();
  const auto odometry = read_all<mrpt::obs::CObservationOdometry>();
  ASSERT_EQ(poses.size(), 7u);  // the lost frame has none
  ASSERT_EQ(odometry.size(), 7u);
  const SE3 V = T_map_vehicle(run, *run.frames[7].T_world_cam);
  EXPECT_LT((from_mrpt(poses[6]->pose.mean).inverse() * V).log().norm(), 1e-9);
  EXPECT_GT(poses[6]->pose.cov(0, 0), 0);
  EXPECT_NEAR(odometry[6]->odometry.x(), V.translation().x(), 1e-9);
  EXPECT_NEAR(odometry[6]->odometry.y(), V.translation().y(), 1e-9);
  EXPECT_NEAR(odometry[6]->odometry.phi(), poses[6]->pose.mean.yaw(), 1e-9);
}

TEST_F(PlaybackFiles, LivePosesComeBeforeTheFinalOnes) {
  edgevo::Run run = small_run();
  run.scale_source = "odometry";
  run.frames[7].T_world_cam_live = run.frames[6].T_world_cam;
  write(run);
  EXPECT_THAT(read_all<mrpt::obs::CObservationComment>().at(0)->text,
              ::testing::StartsWith(
                  "EDGE_VO: is_metric true; EDGE_VO is final, in map; EDGE_VO_LIVE is in odom; unit: "));
  const auto poses = read_all<mrpt::obs::CObservationRobotPose>();
  ASSERT_EQ(poses.size(), 8u);
  EXPECT_EQ(poses[6]->sensorLabel, "EDGE_VO_LIVE");
  EXPECT_EQ(poses[7]->sensorLabel, "EDGE_VO");
  EXPECT_EQ(poses[6]->timestamp, poses[7]->timestamp);
  const SE3 V = T_map_vehicle(run, *run.frames[6].T_world_cam);
  EXPECT_LT((from_mrpt(poses[6]->pose.mean).inverse() * V).log().norm(), 1e-9);
}

// MRPT's own maps must turn pose and scan into the world points.
TEST_F(PlaybackFiles, PointsLandInPlaceInMrptsMaps) {
  edgevo::Run run = small_run();
  run.scale_source = "odometry";
  run.T_vehicle_cam = SE3(T_zup_world().rotation(), Eigen::Vector3d(0.5, 0.1, 1.2));  // with a lever arm
  write(run);
  mrpt::poses::CPose3D vehicle;
  size_t scans = 0;
  for (const auto& obs : read()) {
    if (const auto pose = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(obs))
      vehicle = pose->pose.mean;
    if (!std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(obs)) continue;
    ++scans;
    mrpt::maps::CSimplePointsMap points;
    points.insertionOptions.minDistBetweenLaserPoints = 0;
    points.insertObservation(*obs, vehicle);
    ASSERT_EQ(points.size(), test::world_points().size());
    mrpt::maps::COctoMap octomap(0.1);
    octomap.insertObservation(*obs, vehicle);
    for (size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d expected = T_map_world(run) * test::world_points()[i];
      float x, y, z;
      points.getPoint(i, x, y, z);
      EXPECT_LT((Eigen::Vector3d(x, y, z) - expected).norm(), 1e-3);
      double occupancy = 0;
      ASSERT_TRUE(octomap.getPointOccupancy(x, y, z, occupancy));
      EXPECT_GT(occupancy, 0.5);
    }
  }
  EXPECT_EQ(scans, 3u);
}

TEST_F(PlaybackFiles, LinksLeaveTheSourceAlone) {
  write_png(path("source.png"), frame(1).image);
  PlaybackWriter linking(folder_.string(), camera());
  linking.add_frame_link(0, path("source.png"));
  EXPECT_EQ(read_gray_image(path("playback_Images/frame_000000.png")).pixels, frame(1).image.pixels);
  // A later run that writes images must not write through the link.
  PlaybackWriter writing(folder_.string(), camera());
  writing.add_frame(frame(0));
  EXPECT_EQ(read_gray_image(path("source.png")).pixels, frame(1).image.pixels);
  EXPECT_EQ(read_gray_image(path("playback_Images/frame_000000.png")).pixels, frame(0).image.pixels);
}

TEST_F(PlaybackFiles, LinksSurviveMovingSourceAndRunTogether) {
  namespace fs = std::filesystem;
  fs::create_directories(path("tree/data"));
  write_png(path("tree/data/source.png"), frame(1).image);
  PlaybackWriter(path("tree/out"), camera()).add_frame_link(0, path("tree/data/source.png"));
  fs::rename(path("tree"), path("moved"));
  EXPECT_EQ(read_gray_image(path("moved/out/playback_Images/frame_000000.png")).pixels,
            frame(1).image.pixels);
}

TEST_F(PlaybackFiles, CopiesAreSelfContained) {
  write_png(path("source.png"), frame(1).image);
  PlaybackWriter writer(path("out"), camera());
  writer.add_frame_copy(3, path("source.png"));
  std::filesystem::remove(path("source.png"));
  EXPECT_EQ(read_gray_image(writer.image_path(3)).pixels, frame(1).image.pixels);
  EXPECT_THROW(writer.add_frame_copy(4, path("nowhere.png")), InputError);
  EXPECT_EQ(writer.image_path(4), "");
}

TEST_F(PlaybackFiles, AdoptsTheExistingImages) {
  PlaybackWriter(folder_.string(), camera()).add_frame(frame(12));
  PlaybackWriter(folder_.string(), camera()).add_frame(frame(1234567));
  PlaybackWriter writer(folder_.string(), camera());
  writer.adopt_images(100);
  EXPECT_EQ(writer.image_path(12), path("playback_Images/frame_000012.png"));
  EXPECT_EQ(writer.image_path(1234567), "") << "a frame that the run does not hold";
}

TEST_F(PlaybackFiles, SameRunSameBytes) {
  write(small_run());
  const std::string first = bytes("playback.rawlog");
  write(small_run());
  EXPECT_EQ(bytes("playback.rawlog"), first);
}

TEST_F(PlaybackFiles, EmptyRunGivesAReadableFile) {
  write(edgevo::Run());
  EXPECT_TRUE(read().empty());
  EXPECT_GT(bytes("playback.rawlog").size(), 0u);
}

TEST_F(PlaybackFiles, FullDiskIsReported) {
  std::filesystem::create_symlink("/dev/full", path("playback.rawlog"));
  try {
    write(small_run());
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("playback.rawlog: cannot be written: No space left on device"));
  }
}

TEST_F(PlaybackFiles, ImageThatCannotBeWrittenIsReported) {
  PlaybackWriter writer(folder_.string(), camera());
  std::filesystem::create_directories(path("playback_Images/frame_000000.png/in_the_way"));
  EXPECT_THROW(writer.add_frame(frame(0)), InputError);
}

}  // namespace
}  // namespace edgevo
