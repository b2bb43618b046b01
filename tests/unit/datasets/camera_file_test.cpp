// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/camera_file.h"

#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::error_of;
using ::testing::HasSubstr;

void expect_camera(const Camera& c, const Pinhole& p, const Distortion& d) {
  EXPECT_EQ(c.pinhole().fx, p.fx);
  EXPECT_EQ(c.pinhole().fy, p.fy);
  EXPECT_EQ(c.pinhole().cx, p.cx);
  EXPECT_EQ(c.pinhole().cy, p.cy);
  EXPECT_EQ(c.pinhole().width, p.width);
  EXPECT_EQ(c.pinhole().height, p.height);
  EXPECT_EQ(c.distortion().k1, d.k1);
  EXPECT_EQ(c.distortion().k2, d.k2);
  EXPECT_EQ(c.distortion().p1, d.p1);
  EXPECT_EQ(c.distortion().p2, d.p2);
  EXPECT_EQ(c.distortion().k3, d.k3);
}

TEST(CameraFile, NumbersWithAndWithoutK3) {
  const Pinhole p{517.3, 516.5, 318.6, 255.3, 640, 480};
  expect_camera(parse_camera("# c\r\n517.3 516.5 318.6 255.3 0.1 -0.2 1e-3 2e-3 640 480\r\n", "f"), p,
                {0.1, -0.2, 1e-3, 2e-3, 0});
  expect_camera(parse_camera("517.3 516.5 318.6 255.3 0.1 -0.2 1e-3 2e-3 640 480 0.5", "f"), p,
                {0.1, -0.2, 1e-3, 2e-3, 0.5});
}

TEST(CameraFile, RosCameraInfo) {
  expect_camera(parse_camera(R"(image_width: 640
image_height: 480
camera_name: left
camera_matrix:
  rows: 3
  cols: 3
  data: [517.3, 0, 318.6,   # a comment
         0, 516.5, 255.3, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.1, -0.2, 0.001, 0.002, 0.3]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
)",
                             "f"),
                {517.3, 516.5, 318.6, 255.3, 640, 480}, {0.1, -0.2, 0.001, 0.002, 0.3});
}

TEST(CameraFile, OpenCvCalibration) {
  expect_camera(parse_camera(R"(%YAML:1.0
---
calibration_time: "Mon 1 Jan 2024 10:00:00"
image_Width: 640
image_Height: 480
Camera_Matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 517.3, 0., 318.6, 0., 516.5,
       255.3, 0., 0., 1. ]
Distortion_Coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 0.1, -0.2, 0.001, 0.002, 0.3 ]
)",
                             "f"),
                {517.3, 516.5, 318.6, 255.3, 640, 480}, {0.1, -0.2, 0.001, 0.002, 0.3});
}

TEST(CameraFile, EurocAndMessageStyle) {
  expect_camera(parse_camera(R"(sensor_type: camera
T_BS:
  cols: 4
  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
)",
                             "f"),
                {458.654, 457.296, 367.215, 248.375, 752, 480},
                {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0});
  expect_camera(parse_camera("height: 480\nwidth: 640\nK: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nD: []\n", "f"),
                {500, 501, 320, 240, 640, 480}, {});
}

TEST(CameraFile, KalibrWithOneCamera) {
  const std::string cam0 = R"(cam0:
  cam_overlaps: []
  camera_model: pinhole
  distortion_coeffs: [0.1, -0.2, 0.001, 0.002]
  distortion_model: radtan
  intrinsics: [500.0, 501.0, 320.0, 240.0]
  resolution: [640, 480]
  T_imu_cam:
  - [1.0, 0.0, 0.0, 0.0]
  - [0.0, 1.0, 0.0, 0.0]
  rostopic: /cam0/image_raw
)";
  expect_camera(parse_camera(cam0, "f"), {500, 501, 320, 240, 640, 480}, {0.1, -0.2, 0.001, 0.002, 0});
  EXPECT_THAT(error_of([&] { parse_camera(cam0 + "cam1:\n  resolution: [640, 480]\n", "f"); }),
              HasSubstr("f: several cameras"));
}

struct Bad {
  const char* name;
  const char* text;
  const char* message;
};

class BadCameraFile : public ::testing::TestWithParam<Bad> {};

TEST_P(BadCameraFile, IsReportedInOneLine) {
  const std::string message = error_of([&] { parse_camera(GetParam().text, "cam"); });
  EXPECT_THAT(message, HasSubstr(GetParam().message));
  EXPECT_EQ(message.rfind("cam", 0), 0u) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadCameraFile,
    ::testing::Values(
        Bad{"empty", "# nothing\n", "holds no calibration"},
        Bad{"too_few", "1 2 3 4 5 6 7 8 9", "has 9 fields instead of 10"},
        Bad{"too_many", "1 2 3 4 5 6 7 8 9 10 11 12", "has 12 fields"},
        Bad{"nan", "nan 20 12 8 0 0 0 0 24 16", "'nan' is not a finite number"},
        Bad{"infinite", "20 20 12 8 inf 0 0 0 24 16", "'inf' is not a finite number"},
        Bad{"word", "20 20 12 8 0 0 0 x 24 16", "'x' is not a number"},
        Bad{"half_pixel", "20 20 12 8 0 0 0 0 24.5 16", "not a whole number of pixels"},
        Bad{"negative_focal", "-20 20 12 8 0 0 0 0 24 16", "focal lengths must be positive"},
        Bad{"centre_outside", "20 20 30 8 0 0 0 0 24 16", "principal point lies outside"},
        Bad{"two_lines", "20 20 12 8 0 0 0 0 24 16\n20 20 12 8 0 0 0 0 24 16\n",
            "line 2: a second calibration"},
        Bad{"yaml_no_size", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\n", "image size is missing"},
        Bad{"yaml_no_matrix", "resolution: [640, 480]\n", "camera_matrix is missing"},
        Bad{"yaml_eight_numbers", "resolution: [640, 480]\nK: [500, 0, 320, 0, 501, 240, 0, 0]\n",
            "camera_matrix holds 8 numbers"},
        Bad{"yaml_skew", "resolution: [640, 480]\nK: [500, 2, 320, 0, 501, 240, 0, 0, 1]\n",
            "camera_matrix is not"},
        Bad{"yaml_fisheye",
            "resolution: [640, 480]\nintrinsics: [500, 500, 320, 240]\ndistortion_model: equidistant\n",
            "'equidistant' is not supported"},
        Bad{"yaml_omni", "resolution: [640, 480]\nintrinsics: [500, 500, 320, 240]\ncamera_model: omni\n",
            "'omni' is not supported"},
        Bad{"yaml_rational",
            "resolution: [640, 480]\nintrinsics: [500, 500, 320, 240]\ndistortion_coefficients: [1, 1, 1, 1, "
            "1, 1, 1, 1]\n",
            "holds 8 numbers"},
        Bad{"yaml_bracket", "resolution: [640, 480\n", "a bracket is not closed"},
        Bad{"yaml_twice", "width: 1\nwidth: 2\n", "is given twice"},
        Bad{"yaml_nan", "resolution: [640, .nan]\n", "'.nan' is not a number"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(CameraFile, MissingFile) {
  EXPECT_THAT(error_of([] { read_camera_file("/nowhere/camera.txt"); }),
              HasSubstr("/nowhere/camera.txt: cannot be read"));
}

}  // namespace
}  // namespace edgevo
