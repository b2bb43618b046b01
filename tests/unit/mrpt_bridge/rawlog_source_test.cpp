// SPDX-License-Identifier: BSD-3-Clause
// Every kind of image in every form of rawlog gives the same frames.
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/obs/CSensoryFrame.h>

#include "edgevo/mrpt_bridge/rawlog_import.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"
#include "unit/mrpt_bridge/rawlog_test_tools.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::embedded;
using test::error_of;
using test::expect_frames;
using test::frame_time;
using test::TempFolder;
using ::testing::HasSubstr;

TEST(RawlogSource, EmbeddedImages) {
  TempFolder folder;
  test::write_embedded(folder / "x.rawlog", 4);
  const auto s = test::open(folder / "x.rawlog");
  EXPECT_EQ(s->kind(), "rawlog");
  EXPECT_EQ(s->label(), "CAM0");
  EXPECT_EQ(s->size(), 4);
  EXPECT_EQ(s->camera().pinhole().fx, 20);
  EXPECT_EQ(s->camera().distortion().k3, 0.003);
  ASSERT_TRUE(s->T_vehicle_cam().has_value());
  EXPECT_LT((s->T_vehicle_cam()->matrix() - T_vehicle_cam_forward().matrix()).norm(), 1e-12);
  expect_frames(*s, 4);
}

TEST(RawlogSource, ActionsAndSensoryFrames) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  for (int i = 0; i < 3; ++i) {
    mrpt::obs::CActionCollection actions;
    actions.insert(mrpt::obs::CActionRobotMovement2D());
    mrpt::obs::CSensoryFrame frame;
    frame.insert(mrpt::obs::CObservationOdometry::Create());
    frame.insert(std::make_shared<mrpt::obs::CObservationImage>(embedded(i)));
    writer.write(actions);
    writer.write(frame);
  }
  writer.close();
  const auto s = test::open(folder / "x.rawlog");
  EXPECT_EQ(s->size(), 3);
  expect_frames(*s, 3);
}

// As when a source fails in the middle of an import: what was written is complete.
TEST(RawlogSource, OfAWriterThatWasNotClosed) {
  TempFolder folder;
  {
    RawlogWriter writer(folder / "x.rawlog");
    for (int i = 0; i < 3; ++i) writer.write(embedded(i));
  }
  const auto s = test::open(folder / "x.rawlog");
  EXPECT_EQ(s->size(), 3);
  expect_frames(*s, 3);
}

TEST(RawlogSource, LeftImageOfStereo) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  for (int i = 0; i < 2; ++i) {
    mrpt::obs::CObservationStereoImages o;
    o.sensorLabel = "STEREO";
    o.timestamp = to_mrpt(frame_time(i));
    o.imageLeft = to_mrpt(test::make_image(i));
    o.imageRight = to_mrpt(test::make_image(i + 50));
    o.hasImageRight = true;
    o.leftCamera = o.rightCamera = to_mrpt(test::small_camera());
    o.cameraPose = mrpt::poses::CPose3DQuat(to_mrpt(T_vehicle_cam_forward()));
    writer.write(o);
  }
  writer.close();
  const auto s = test::open(folder / "x.rawlog", "STEREO");
  EXPECT_LT((s->T_vehicle_cam()->matrix() - T_vehicle_cam_forward().matrix()).norm(), 1e-12);
  expect_frames(*s, 2);
}

TEST(RawlogSource, IntensityImageOfADepthCamera) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  for (int i = 0; i < 2; ++i) {
    mrpt::obs::CObservation3DRangeScan o;
    o.sensorLabel = "KINECT";
    o.timestamp = to_mrpt(frame_time(i));
    o.sensorPose = mrpt::poses::CPose3D(0.5, 0, 1.0, 0, 0, 0);
    o.hasIntensityImage = true;
    o.intensityImage = to_mrpt(test::make_image(i));
    o.cameraParamsIntensity = to_mrpt(test::small_camera());
    writer.write(o);
    o.hasIntensityImage = false;  // depth alone is not a frame
    writer.write(o);
  }
  writer.close();
  const auto s = test::open(folder / "x.rawlog");
  ASSERT_TRUE(s->T_vehicle_cam().has_value());
  EXPECT_LT((s->T_vehicle_cam()->translation() - Eigen::Vector3d(0.5, 0, 1.0)).norm(), 1e-9);
  EXPECT_LT((s->T_vehicle_cam()->R() - T_vehicle_cam_forward().R()).norm(), 1e-6);
  expect_frames(*s, 2);
}

TEST(RawlogSource, IdentityMountIsNoMount) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  auto o = embedded(0);
  o.cameraPose = mrpt::poses::CPose3D();
  writer.write(o);
  writer.close();
  EXPECT_FALSE(test::open(folder / "x.rawlog")->T_vehicle_cam().has_value());
}

TEST(RawlogSource, ColourGivesTheBytesOfTheFile) {
  TempFolder folder;
  mrpt::img::CImage colour(24, 16, mrpt::img::CH_RGB);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x)
      colour.setPixel(x, y, size_t(x * 10) << 16 | size_t(y * 15) << 8 | size_t(x * y % 256));
  ASSERT_TRUE(colour.saveToFile(folder / "colour.png"));
  const GrayImage from_file = read_gray_image(folder / "colour.png");
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);
  RawlogWriter writer(folder / "x.rawlog");
  auto o = embedded(0);
  o.image = colour;
  writer.write(o);
  writer.close();
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
  EXPECT_TRUE(test::same_pixels(test::open(folder / "x.rawlog")->next()->image, from_file));
}

TEST(RawlogSource, ExternalImagesInEveryFolderName) {
  for (const char* images : {"x_Images", "x_images", "x_IMAGES", "Images"}) {
    TempFolder folder;
    fs::create_directories(folder / images);
    RawlogWriter writer(folder / "x.rawlog");
    for (int i = 0; i < 2; ++i) {
      const std::string name = "I" + std::to_string(i) + ".png";
      write_png(folder / (std::string(images) + "/" + name), test::make_image(i));
      writer.write(test::external(i, name));
    }
    writer.close();
    expect_frames(*test::open(folder / "x.rawlog"), 2);
    EXPECT_EQ(test::open(folder / "x.rawlog")->next()->image_path,
              folder / (std::string(images) + "/I0.png"));
  }
}

TEST(RawlogSource, ExternalImagesByAbsoluteName) {
  TempFolder folder;
  fs::create_directories(folder / "x_Images");
  write_png(folder / "elsewhere.png", test::make_image(0));
  RawlogWriter writer(folder / "x.rawlog");
  writer.write(test::external(0, folder / "elsewhere.png"));
  writer.close();
  expect_frames(*test::open(folder / "x.rawlog"), 1);
}

TEST(RawlogSource, SeveralCamerasNeedALabel) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  for (int i = 0; i < 3; ++i) {
    writer.write(embedded(i, "LEFT"));
    if (i < 2) writer.write(embedded(i + 10, "RIGHT"));
  }
  writer.close();
  EXPECT_THAT(
      error_of([&] { test::open(folder / "x.rawlog"); }),
      HasSubstr("several cameras: LEFT (3 images), RIGHT (2 images); choose one with --sensor LABEL"));
  EXPECT_THAT(error_of([&] { test::open(folder / "x.rawlog", "LEFFT"); }),
              HasSubstr("did you mean --sensor LEFT?"));
  EXPECT_EQ(test::open(folder / "x.rawlog", "RIGHT")->size(), 2);
  expect_frames(*test::open(folder / "x.rawlog", "LEFT"), 3);
}

TEST(RawlogSource, SkipLeavesImagesAlone) {
  TempFolder folder;
  fs::create_directories(folder / "x_Images");
  write_png(folder / "x_Images/1.png", test::make_image(1));
  RawlogWriter writer(folder / "x.rawlog");
  writer.write(test::external(0, "missing.png"));
  writer.write(test::external(1, "1.png"));
  writer.close();
  const auto s = test::open(folder / "x.rawlog");
  EXPECT_TRUE(s->skip());
  const auto frame = s->next();
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->index, 1);
  EXPECT_FALSE(s->skip());
}

TEST(RawlogSource, GivenCameraWins) {
  TempFolder folder;
  test::write_embedded(folder / "x.rawlog", 1);
  Camera other = test::small_camera();
  Pinhole longer = other.pinhole();
  longer.fx = 33;
  other.set_pinhole(longer);
  EXPECT_EQ(open_rawlog({folder / "x.rawlog", "", other})->camera().pinhole().fx, 33);
}

TEST(RawlogSource, ReadsConcatenatedAndUncompressedFiles) {
  TempFolder folder;
  test::write_embedded(folder / "a.rawlog", 2);
  RawlogWriter writer(folder / "b.rawlog");
  writer.write(embedded(2));
  writer.close();
  test::write_text(folder / "both.rawlog",
                   test::read_text(folder / "a.rawlog") + test::read_text(folder / "b.rawlog"));
  expect_frames(*test::open(folder / "both.rawlog"), 3);
  test::write_text(folder / "plain.rawlog", test::inflate(folder / "a.rawlog"));
  expect_frames(*test::open(folder / "plain.rawlog"), 2);
}

TEST(RawlogSource, ReaderKeepsOtherObservations) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  mrpt::obs::CObservationOdometry odometry;
  odometry.sensorLabel = "ODO";
  writer.write(odometry);
  writer.write(embedded(0));
  writer.close();
  RawlogReader reader(folder / "x.rawlog");
  EXPECT_EQ(reader.next()->sensorLabel, "ODO");
  EXPECT_EQ(reader.next()->sensorLabel, "CAM0");
  EXPECT_EQ(reader.next(), nullptr);
  EXPECT_EQ(reader.next(), nullptr);
  EXPECT_EQ(reader.objects_read(), 2);
}

}  // namespace
}  // namespace edgevo
