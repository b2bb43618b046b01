// SPDX-License-Identifier: BSD-3-Clause
// Each layout gives the same frames: pixels, ticks, camera.
#include "edgevo/datasets/describe.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using test::make_image;
using test::read_all;
using test::same_pixels;
using test::TempFolder;
using test::write_images;
using test::write_text;
using ::testing::HasSubstr;

SourceOptions source(const std::string& path, const std::string& camera = "") {
  SourceOptions options;
  options.path = path;
  options.camera_file = camera;
  return options;
}

void expect_frames(const std::vector<Frame>& frames, size_t count) {
  ASSERT_EQ(frames.size(), count);
  for (size_t i = 0; i < count; ++i) {
    EXPECT_EQ(frames[i].index, int(i));
    EXPECT_TRUE(same_pixels(frames[i].image, make_image(int(i)))) << "frame " << i;
  }
}

TEST(EdgevoLayout, GivesPixelsTicksAndCamera) {
  TempFolder folder;
  test::write_edgevo_layout(folder.path(), 3);
  const auto s = open_source(source(folder.path()));
  EXPECT_EQ(s->kind(), "edgevo folder");
  EXPECT_EQ(s->size(), 3);
  EXPECT_EQ(s->camera().pinhole().fx, 20);
  EXPECT_EQ(s->camera().distortion().k3, 0.003);
  EXPECT_EQ(s->ground_truth_path(), folder / "groundtruth_tum.txt");
  const auto frames = read_all(*s);
  expect_frames(frames, 3);
  EXPECT_EQ(frames[0].time.ticks, 13050311021753041);
  EXPECT_EQ(frames[2].time.ticks, 13050311021953041);
  EXPECT_EQ(s->times().size(), 3u);
  EXPECT_EQ(s->times()[2], frames[2].time);
}

TEST(EdgevoLayout, GivenCameraWins) {
  TempFolder folder;
  test::write_edgevo_layout(folder.path(), 1);
  write_text(folder / "other.txt", "30 30 12 8 0 0 0 0 24 16");
  EXPECT_EQ(open_source(source(folder.path(), folder / "other.txt"))->camera().pinhole().fx, 30);
}

// DSO's camera.txt, and times.txt with names, whose order counts.
TEST(EdgevoLayout, ReadsTheFilesOfDso) {
  TempFolder folder;
  write_images(folder / "images", 3);
  write_text(folder / "camera.txt", "1 1 0.5 0.5 0\n24 16\ncrop\n20 10\n");
  write_text(folder / "times.txt", "000000 17.5\n000001 17.6 0.01\n000002 17.7\n");
  const auto s = open_source(source(folder.path()));
  EXPECT_EQ(s->camera().pinhole().fx, 24);
  const auto frames = read_all(*s);
  expect_frames(frames, 3);
  EXPECT_EQ(frames[1].time.ticks, 176000000);
  write_text(folder / "times.txt", "000001 17.6\n000002 17.7\n");
  const auto fewer = open_source(source(folder.path()));
  EXPECT_THAT(input_warnings(fewer->decisions()), ::testing::Contains(HasSubstr("1 image(s) have no line")));
  EXPECT_EQ(read_all(*fewer).size(), 2u);
  write_text(folder / "times.txt", "000000 17.5\nb 17.6\n000002 17.7\n");
  EXPECT_THAT(error_of([&] { open_source(source(folder.path())); }),
              HasSubstr("times.txt, line 2: names no image of the folder: 'b'"));
}

TEST(DavisLayout, TimesNamesAndCamera) {
  TempFolder folder;
  write_images(folder / "images", 2);
  write_text(folder / "images.txt", "0.0 images/000000.png\n0.04 images/000001.png\n");
  write_text(folder / "calib.txt", "20 21 12 8 -0.13 0.09 -0.0003 0.0001 0.0\n");
  write_text(folder / "groundtruth.txt", "0 0 0 0 0 0 0 1\n");
  const auto s = open_source(source(folder.path()));
  EXPECT_EQ(s->kind(), "DAVIS");
  EXPECT_EQ(s->camera().pinhole().fy, 21);
  EXPECT_EQ(s->camera().pinhole().width, 24);
  EXPECT_EQ(s->ground_truth_path(), folder / "groundtruth.txt");
  EXPECT_THAT(to_string(s->decisions().at(0)), HasSubstr("for 24x16 (the file has no image size"));
  const auto frames = read_all(*s);
  expect_frames(frames, 2);
  EXPECT_EQ(frames[1].time.ticks, 400000);
}

TEST(EurocLayout, NamesItsCamerasWhereOneIsMissing) {
  TempFolder folder;
  fs::create_directories(folder / "mav0/cam0");
  const auto why = [&](const char* label) {
    SourceOptions options = source(folder.path());
    options.sensor_label = label;
    return error_of([&] { open_source(options); });
  };
  EXPECT_THAT(why(""),
              HasSubstr("cam0/data.csv: is missing, which lists the images and their times; restore"));
  write_text(folder / "mav0/cam1/data.csv", "1,0.png\n");
  EXPECT_THAT(why(""), HasSubstr("no camera 'cam0'; there are cam1; did you mean --sensor cam1?"));
}

// Images without a calibration are described, and run with --fov.
TEST(EurocLayout, NeedsNoCalibrationForInfo) {
  TempFolder folder;
  write_images(folder / "mav0/cam0/data", 2);
  write_text(folder / "mav0/cam0/data.csv", "1000000000,000000.png\n2000000000,000001.png\n");
  SourceOptions options = source(folder.path());
  EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("no calibration"));
  options.any_camera = true;
  EXPECT_THAT(describe(*open_source(options)),
              ::testing::Contains(::testing::Pair("camera", HasSubstr("not known"))));
  options.any_camera = false;
  options.fov_deg = 90;
  EXPECT_NEAR(open_source(options)->camera().pinhole().fx, 12, 1e-9);
}

TEST(KittiLayout, CameraTimesAndGroundTruth) {
  TempFolder folder;
  const std::string root = folder / "sequences/07";
  write_images(root + "/image_0", 2);
  write_images(root + "/image_2", 2);
  write_text(root + "/times.txt", "0.000000e+00\n1.036224e-01\n");
  write_text(
      root + "/calib.txt",
      "P0: 20 0 12 0 0 21 8 0 0 0 1 0\nP1: 20 0 12 -8 0 21 8 0 0 0 1 0\nP2: 20 0 11 2 0 21 8 0 0 0 1 0\n");
  write_text(folder / "poses/07.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 1 3 0 1 0 0 -1 0 0 5\n");
  SourceOptions options = source(root + "/");
  const auto s = open_source(options);
  EXPECT_EQ(s->kind(), "KITTI odometry");
  EXPECT_EQ(s->camera().pinhole().cx, 12);
  EXPECT_EQ(s->camera().pinhole().width, 24);
  const auto frames = read_all(*s);
  expect_frames(frames, 2);
  EXPECT_EQ(frames[1].time.ticks, 1036224);
  // The second pose turns by 90 degrees about y: z of the camera is x of the world.
  const std::string truth = ground_truth_tum(options, *s);
  EXPECT_THAT(truth, HasSubstr("\n0.0000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
                               "0.000000000 1.000000000\n"));
  EXPECT_THAT(truth, HasSubstr("\n0.1036224 3.000000000 0.000000000 5.000000000 0.000000000 0.707106781 "
                               "0.000000000 0.707106781\n"));

  options.sensor_label = "image_2";
  const auto colour = open_source(options);
  EXPECT_EQ(colour->camera().pinhole().cx, 11);
  EXPECT_THAT(ground_truth_tum(options, *colour),
              HasSubstr("\n0.0000000 -0.100000000 0.000000000 0.000000000 "));

  options.sensor_label = "image_1";
  EXPECT_THAT(error_of([&] { open_source(options); }),
              HasSubstr("no camera 'image_1'; there are image_0, image_2"));
}

TEST(TumLayout, PublishedCameraByName) {
  TempFolder folder;
  const std::string root = folder / "rgbd_dataset_freiburg2_desk";
  fs::create_directories(root + "/rgb");
  write_png(root + "/rgb/1.5.png", make_image(0, 640, 480));
  write_text(root + "/rgb.txt", "# color images\n1.5 rgb/1.5.png\n");
  write_text(root + "/groundtruth.txt", "1.5 0 0 0 0 0 0 1\n");
  const auto s = open_source(source(root));
  EXPECT_EQ(s->kind(), "TUM RGB-D");
  EXPECT_EQ(s->camera().pinhole().fx, 520.908620);
  EXPECT_EQ(s->ground_truth_path(), root + "/groundtruth.txt");
  EXPECT_EQ(read_all(*s).at(0).time.ticks, 15000000);
  write_text(root + "/rgb.txt", "1.5 rgb/1.5.png\n1.6 rgb/1.6.png\n");
  EXPECT_EQ(test::frames_before_error(*open_source(source(root)), "rgb/1.6.png: the image is missing"), 1);
  fs::rename(root, folder / "desk");
  EXPECT_THAT(error_of([&] { open_source(source(folder / "desk")); }),
              HasSubstr("give the camera's file with --camera"));
}

TEST(EurocLayout, TimesInNanosecondsAndGroundTruthOfTheCamera) {
  TempFolder folder;
  const std::string cam = folder / "mav0/cam0";
  fs::create_directories(cam + "/data");
  write_png(cam + "/data/1403636579763555584.png", make_image(0));
  write_text(cam + "/data.csv",
             "#timestamp [ns],filename\r\n1403636579763555584,1403636579763555584.png\r\n");
  write_text(cam + "/sensor.yaml",
             "# Camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0, -1, 0, 0.5,\n    1, 0, 0, 0,\n    0, 0, 1, "
             "0,\n    0, 0, 0, 1]\n"
             "resolution: [24, 16]\nintrinsics: [20, 21, 12, 8]\ndistortion_model: radial-tangential\n"
             "distortion_coefficients: [0.1, 0, 0, 0]\n");
  write_text(folder / "mav0/state_groundtruth_estimate0/data.csv",
             "#timestamp, x\n1403636579763555584,1,2,3,1,0,0,0,0,0,0\n");
  const auto s = open_source(source(folder.path()));
  EXPECT_EQ(s->kind(), "EuRoC");
  EXPECT_EQ(s->camera().distortion().k1, 0.1);
  expect_frames(read_all(*s), 1);
  EXPECT_EQ(s->times().at(0).ticks, 14036365797635556);
  EXPECT_FALSE(s->T_vehicle_cam().has_value());
  EXPECT_THAT(ground_truth_tum(source(folder.path()), *s),
              HasSubstr("\n1403636579.7635556 1.500000000 2.000000000 3.000000000 0.000000000 0.000000000 "
                        "0.707106781 0.707106781\n"));
  // The user may name mav0/ itself.
  EXPECT_EQ(open_source(source(folder / "mav0"))->kind(), "EuRoC");
}

TEST(ImageFolder, SortsNumbersByValueAndTakesTheRate) {
  TempFolder folder;
  write_text(folder / "camera.txt", test::kCameraLine);
  for (int i : {0, 1, 2, 9, 10, 11, 100}) {
    fs::create_directories(folder / "frames");
    write_png(folder / ("frames/img_" + std::to_string(i) + ".png"), make_image(i));
  }
  SourceOptions options = source(folder / "frames", folder / "camera.txt");
  auto frames = read_all(*open_source(options));
  ASSERT_EQ(frames.size(), 7u);
  EXPECT_TRUE(same_pixels(frames[3].image, make_image(9)));
  EXPECT_TRUE(same_pixels(frames[4].image, make_image(10)));
  EXPECT_TRUE(same_pixels(frames[6].image, make_image(100)));
  EXPECT_EQ(frames[3].time.ticks, 1000000);  // 30 a second
  EXPECT_EQ(open_source(options)->decisions().at(0).value, "30 frames a second assumed");
  options.fps = 4;
  frames = read_all(*open_source(options));
  EXPECT_EQ(frames[3].time.ticks, 7500000);
}

TEST(ImageFolder, TakesTimesFromNames) {
  TempFolder folder;
  write_text(folder / "camera.txt", test::kCameraLine);
  fs::create_directories(folder / "ns");
  write_png(folder / "ns/1403636579763555584.png", make_image(0));
  write_png(folder / "ns/1403636579813555456.png", make_image(1));
  fs::create_directories(folder / "s");
  write_png(folder / "s/1305031102.175304.png", make_image(0));
  EXPECT_EQ(open_source(source(folder / "ns", folder / "camera.txt"))->times().at(1).ticks,
            14036365798135555);
  EXPECT_EQ(open_source(source(folder / "s", folder / "camera.txt"))->times().at(0).ticks, 13050311021753040);
}

TEST(ImageFolder, ColourGivesCvtColorWeights) {
  TempFolder folder;
  // A binary PPM with one pixel of pure red, green and blue.
  write_text(folder / "colour/0.ppm",
             std::string("P6\n3 1\n255\n") + std::string("\xff\0\0\0\xff\0\0\0\xff", 9));
  write_text(folder / "camera.txt", "1 1 1.5 0.5 0 0 0 0 3 1");
  const auto frames = read_all(*open_source(source(folder / "colour", folder / "camera.txt")));
  EXPECT_EQ(frames.at(0).image.pixels, (std::vector<uint8_t>{76, 150, 29}));
}

std::map<std::string, std::string> description_of(const std::string& folder) {
  std::map<std::string, std::string> lines;
  for (const auto& [name, value] : describe(*open_source(source(folder)))) lines[name] = value;
  return lines;
}

TEST(DescribeSource, SaysWhatIsThere) {
  TempFolder folder;
  test::write_edgevo_layout(folder.path(), 5);
  write_text(folder / "times.txt", "0\n0.1\n0.2\n1.2\n1.3\n");
  std::map<std::string, std::string> lines = description_of(folder.path());
  EXPECT_EQ(lines["frames"], "5");
  EXPECT_EQ(lines["image size"], "24 x 16");
  EXPECT_EQ(lines["rate"], "10.00 Hz (median step 100.00 ms)");
  EXPECT_EQ(lines["gaps in time"], "1; the longest is 1.000 s, before frame 3");
  EXPECT_THAT(lines["duration"], HasSubstr("1.300 s"));
}

TEST(DescribeSource, SaysThatAListRunsBackwards) {
  TempFolder folder;
  test::write_edgevo_layout(folder.path(), 5);
  write_text(folder / "times.txt", "1.3\n1.2\n0.2\n0.1\n0\n");
  std::map<std::string, std::string> lines = description_of(folder.path());
  EXPECT_EQ(lines["wrong times"], "4 frames are not after the one before; the first is frame 1");
  EXPECT_THAT(lines["order"], HasSubstr("backwards"));
  EXPECT_THAT(lines["WARNING"], HasSubstr("turn the list round"));
}

TEST(DescribeSource, FieldOfViewOfAPinhole) {
  const Camera camera{{100, 100, 99.5, 49.5, 200, 100}, {}};
  const auto [horizontal, vertical] = field_of_view_deg(camera);
  EXPECT_NEAR(horizontal, 90, 1e-9);
  EXPECT_NEAR(vertical, 2 * std::atan(0.5) * 180 / M_PI, 1e-9);
}

}  // namespace
}  // namespace edgevo
