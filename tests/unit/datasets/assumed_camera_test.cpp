// SPDX-License-Identifier: BSD-3-Clause
// Images without a calibration: --fov, or EXIF data of a photo.
#include "assumed_camera.h"

#include <opencv2/imgcodecs.hpp>

#include "edgevo/datasets/describe.h"
#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::TempFolder;
using ::testing::HasSubstr;

// A TIFF header, one entry that points to the EXIF part, and there the focal length in 35 mm terms (tag A405,
// a short).
std::string exif_segment(int mm) {
  using namespace std::string_literals;
  std::string tiff = "MM\0\x2a\0\0\0\x08"s +
                     "\0\x01"
                     "\x87\x69\0\x04\0\0\0\x01\0\0\0\x1a"
                     "\0\0\0\0"s +
                     "\0\x01"
                     "\xa4\x05\0\x03\0\0\0\x01"s;
  tiff += char(mm >> 8);
  tiff += char(mm & 255);
  tiff += "\0\0\0\0\0\0"s;
  const std::string body = "Exif\0\0"s + tiff;
  const size_t length = body.size() + 2;
  return "\xff\xe1"s + char(length >> 8) + char(length & 255) + body;
}

// `mm` < 0: without EXIF data.
void write_jpeg(const std::string& path, int mm) {
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", cv::Mat(90, 120, CV_8UC1, cv::Scalar(100)), bytes);
  std::string text(bytes.begin(), bytes.end());
  if (mm >= 0) text.insert(2, exif_segment(mm));  // behind the mark that begins an image
  test::write_text(path, text);
}

std::string assumption(const ImageSource& source) {
  for (const InputDecision& d : source.decisions())
    if (d.subject == "camera" && !d.doubt.empty()) return d.value + ", " + d.reason;
  return "none";
}

class AssumedCamera : public ::testing::Test {
 protected:
  std::unique_ptr<ImageSource> photos(int mm) {
    for (int i = 0; i < 3; ++i) write_jpeg(folder_ / ("photos/" + std::to_string(i) + ".jpg"), mm);
    options_.path = folder_ / "photos";
    return open_source(options_);
  }
  TempFolder folder_;
  SourceOptions options_;
};

TEST_F(AssumedCamera, HasTheGivenFieldOfView) {
  options_.fov_deg = 70;
  const auto source = photos(-1);
  const Pinhole p = source->camera().pinhole();
  EXPECT_EQ(p.width, 120);
  EXPECT_EQ(p.height, 90);
  EXPECT_NEAR(2 * std::atan(60 / p.fx) * 180 / M_PI, 70, 1e-9);
  EXPECT_EQ(p.fx, p.fy);
  EXPECT_EQ(p.cx, 59.5);
  EXPECT_EQ(p.cy, 44.5);
  EXPECT_NEAR(field_of_view_deg(source->camera()).first, 70, 1);
  EXPECT_THAT(assumption(*source),
              HasSubstr("assumed, f 86 px, by --fov, 70.0 degrees over the width; no lens distortion"));
  EXPECT_EQ(test::read_all(*source).size(), 3u);
}

TEST_F(AssumedCamera, IsCheckedByItself) {
  options_.fov_deg = 5;
  const auto warnings = input_warnings(photos(-1)->decisions());
  ASSERT_FALSE(warnings.empty());
  EXPECT_THAT(warnings.back(), HasSubstr("Check --fov, or give a calibration with --camera."));
  for (const std::string& w : warnings) EXPECT_EQ(w.find("Check the camera file"), std::string::npos) << w;
}

TEST_F(AssumedCamera, DoubtsACameraFileOfAnotherFocalLength) {
  test::write_text(folder_ / "camera.txt", "60 60 59.5 44.5 0 0 0 0 120 90");
  options_.camera_file = folder_ / "camera.txt";
  const auto doubted = input_warnings(photos(28)->decisions());  // 97 px
  ASSERT_EQ(doubted.size(), 1u);
  EXPECT_THAT(doubted[0], HasSubstr("EXIF data of the images say a focal length of about 97 px, not 60"));
  EXPECT_TRUE(input_warnings(photos(17)->decisions()).empty());
  EXPECT_TRUE(input_warnings(photos(-1)->decisions()).empty());
}

// A telephone held upright: the angle that its maker states is that of the longer side. Landscape: as ever.
TEST_F(AssumedCamera, HasItsAngleOverTheLongerSide) {
  for (const auto& [width, height] : {std::pair(120, 90), {90, 120}}) {
    const Pinhole p = camera_of_field_of_view(70, width, height).pinhole();
    EXPECT_NEAR(2 * std::atan(60 / p.fx) * 180 / M_PI, 70, 1e-9);
  }
  std::filesystem::create_directories(folder_ / "photos");
  write_png(folder_ / "photos/0.png", test::make_image(0, 30, 40));
  options_.path = folder_ / "photos";
  options_.fov_deg = 56;
  EXPECT_THAT(assumption(*open_source(options_)), HasSubstr("over the height, which is the longer side"));
}

// Whatever the angle: it is a doubt, and not one that depends on what self-calibration finds.
TEST_F(AssumedCamera, IsAlwaysADoubt) {
  for (const double fov : {30, 40, 45, 50, 56}) {
    options_.fov_deg = fov;
    EXPECT_THAT(input_warnings(photos(-1)->decisions()), ::testing::ElementsAre(HasSubstr("It is a guess")));
  }
}

// `edgevo info` shows what is in a folder without a calibration, and shows no numbers of a camera.
TEST_F(AssumedCamera, IsNotNeededForInfo) {
  options_.any_camera = true;
  const auto source = photos(-1);
  const auto lines = describe(*source);
  EXPECT_THAT(lines, ::testing::Contains(::testing::Pair("image size", "120 x 90")));
  EXPECT_THAT(lines, ::testing::Contains(::testing::Pair("camera", HasSubstr("not known (no calibration"))));
  EXPECT_THAT(lines, ::testing::Not(::testing::Contains(::testing::Pair("field of view", ::testing::_))));
}

TEST_F(AssumedCamera, FollowsThePhotosFocalLength) {
  const auto source = photos(26);
  EXPECT_NEAR(source->camera().pinhole().fx, 26 / 43.267 * 150, 1e-9);  // 150 px from corner to corner
  EXPECT_THAT(assumption(*source), HasSubstr("26 mm in terms of 35 mm film"));
}

TEST_F(AssumedCamera, NeedsSomeInformation) {
  const auto why = [&](int mm) -> std::string {
    try {
      photos(mm);
    } catch (const InputError& e) {
      return e.what();
    }
    return "not refused";
  };
  EXPECT_THAT(why(-1), HasSubstr("no calibration; give the camera's file with --camera"));
  EXPECT_THAT(why(0), HasSubstr("or its angle with --fov"));  // EXIF's way to say that it is not known
  options_.any_camera = true;
  EXPECT_EQ(photos(-1)->camera().pinhole().width, 120);
}

TEST_F(AssumedCamera, YieldsToACalibration) {
  test::write_text(folder_ / "camera.txt", "100 100 60 45 0 0 0 0 120 90");
  options_.camera_file = folder_ / "camera.txt";
  const auto source = photos(26);
  EXPECT_EQ(source->camera().pinhole().fx, 100);
  EXPECT_EQ(assumption(*source), "none");
}

// --fov overrides a layout's own calibration, but is an error where a layout always has one.
TEST_F(AssumedCamera, OverridesASourcesOwn) {
  test::write_images(folder_ / "own/images", 2);
  test::write_text(folder_ / "own/times.txt", test::make_times(2));
  test::write_text(folder_ / "own/camera.txt", test::kCameraLine);
  options_.path = folder_ / "own";
  EXPECT_EQ(open_source(options_)->camera().pinhole().fx, 20);
  options_.fov_deg = 90;
  EXPECT_NEAR(open_source(options_)->camera().pinhole().fx, 12, 1e-9);
  test::write_images(folder_ / "kitti/image_0", 2);
  test::write_text(folder_ / "kitti/times.txt", "0\n0.1\n");
  test::write_text(folder_ / "kitti/calib.txt", "P0: 20 0 12 0 0 20 8 0 0 0 1 0\n");
  options_.path = folder_ / "kitti";
  try {
    open_source(options_);
    FAIL() << "--fov was taken";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("has its own calibration; omit it"));
  }
}

}  // namespace
}  // namespace edgevo
