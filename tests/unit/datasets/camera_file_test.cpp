// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/camera_file.h"

#include "camera_forms.h"
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

TEST(CameraFile, NumbersInPlaceOfAFile) {
  expect_camera(read_camera_file("517.3 516.5 318.6 255.3 0.1 -0.2 1e-3 2e-3 640 480"),
                {517.3, 516.5, 318.6, 255.3, 640, 480}, {0.1, -0.2, 1e-3, 2e-3, 0});
  EXPECT_FALSE(read_camera_mount("517.3 516.5 318.6 255.3 0 0 0 0 640 480"));
  EXPECT_FALSE(read_camera_gyro("517.3 516.5 318.6 255.3 0 0 0 0 640 480"));
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
              HasSubstr("f: holds several cameras; choose one with --sensor: cam0, cam1"));
}

// ---- forms that other programs write ----

struct Form {
  const char* name;
  const char* text;
};

const Pinhole kFormPinhole{707.5, 708.5, 601.5, 183.5, 1226, 370};
const Distortion kFormLens{-0.31, 0.11, 0.001, 0.0002, 0.5};

class CameraForm : public ::testing::TestWithParam<Form> {};

TEST_P(CameraForm, IsRead) { expect_camera(parse_camera(GetParam().text, "f"), kFormPinhole, kFormLens); }

#define EDGEVO_SIZE "image_width: 1226\nimage_height: 370\n"
#define EDGEVO_FLOW "[707.5, 0.0, 601.5, 0.0, 708.5, 183.5, 0.0, 0.0, 1.0]\n"

INSTANTIATE_TEST_SUITE_P(
    All, CameraForm,
    ::testing::Values(
        Form{"block_list", EDGEVO_SIZE
             "camera_matrix:\n  rows: 3\n  cols: 3\n  data:\n  - 707.5\n  - 0.0\n  - 601.5\n  - 0.0\n  "
             "- 708.5\n  - 183.5\n  - 0.0\n  - 0.0\n  - 1.0\ndistortion_coefficients:\n- -0.31\n- 0.11\n"
             "- 0.001\n- 0.0002\n- 0.5\n"},
        Form{"block_of_rows", EDGEVO_SIZE
             "camera_matrix:\n- - 707.5\n  - 0\n  - 601.5\n- - 0\n  - 708.5\n  - 183.5\n- [0, 0, 1]\n"
             "dist: [-0.31, 0.11, 0.001, 0.0002, 0.5]\n"},
        Form{"nested_lists", EDGEVO_SIZE "camera_matrix: [[707.5, 0, 601.5], [0, 708.5, 183.5], [0, 0, 1]]\n"
                                         "dist_coeff: [[-0.31, 0.11, 0.001, 0.0002, 0.5]]\n"},
        Form{"dist_coeffs", EDGEVO_SIZE
             "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: " EDGEVO_FLOW
             "dist_coeffs: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ "
             "-0.31, 0.11, 0.001, 0.0002, 0.5 ]\n"},
        Form{"camel_case",
             EDGEVO_SIZE "cameraMatrix: " EDGEVO_FLOW "distCoeffs: [-0.31, 0.11, 0.001, 0.0002, 0.5]\n"},
        Form{"opencv_stereo", "%YAML:1.0\n---\nR: [1]\nT: [0]\n" EDGEVO_SIZE "M1: " EDGEVO_FLOW
                              "D1: [-0.31, 0.11, 0.001, 0.0002, 0.5]\nM2: [2]\nD2: [3]\nalpha1: 0.\n"},
        Form{"opencv_sample",
             "%YAML:1.0\n---\ncalibration_time: \"Tue 11:12\"\nnr_of_frames: 25\nboard_width: 9\n"
             "square_size: 50.\nflags: 10\nfisheye_model: 0\n" EDGEVO_SIZE "camera_matrix: " EDGEVO_FLOW
             "distortion_coefficients: [-0.31, 0.11, 0.001, 0.0002, 0.5]\navg_reprojection_error: 0.3\n"
             "per_view_reprojection_errors: !!opencv-matrix\n   data: [1, 2]\n"},
        Form{"camera_info_echo",
             "header:\n  stamp:\n    sec: 17\n  frame_id: c\nheight: 370\nwidth: 1226\n"
             "distortion_model: plumb_bob\nd:\n- -0.31\n- 0.11\n- 0.001\n- 0.0002\n- 0.5\nk: " EDGEVO_FLOW
             "r:\n- 1.0\n- 0.0\np: [1]\nbinning_x: 0\nbinning_y: 1\nroi:\n  x_offset: 0\n  "
             "width: 0\n  do_rectify: false\n---\nheight: 370\nwidth: 1226\nD: [-0.31, 0.11, 0.001, "
             "0.0002, 0.5]\nK: " EDGEVO_FLOW "---\n"},
        Form{"rational_with_zeros",
             EDGEVO_SIZE "distortion_model: rational_polynomial\ncamera_matrix: " EDGEVO_FLOW
                         "D: [-0.31, 0.11, 0.001, 0.0002, 0.5, 0, 0, 0]\n"},
        Form{"ost_txt",
             "# oST version 5.0 parameters\n\n[image]\n\nwidth\n1226\n\nheight\n370\n\n[narrow_stereo]\n\n"
             "camera matrix\n707.5 0 601.5\n0 708.5 183.5\n0 0 1\n\ndistortion\n-0.31 0.11 0.001 0.0002 "
             "0.5\n\nrectification\n1 0 0\n0 1 0\n0 0 1\n"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(CameraFile, DsoCamera) {
  const Pinhole p{707.5, 708.5, 601.5, 183.5, 1226, 370};
  expect_camera(parse_camera("707.5 708.5 601.5 183.5 0\n1226 370\ncrop\n640 360\n", "f"), p, {});
  expect_camera(parse_camera("Pinhole 707.5 708.5 601.5 183.5 0\n1226 370\n", "f"), p, {});
  expect_camera(parse_camera("RadTan 707.5 708.5 601.5 183.5 -0.3 0.1 0.01 0.02\n1226 370\nnone\n", "f"), p,
                {-0.3, 0.1, 0.01, 0.02, 0});
  // Relative to the image, whose corner is then 0.
  expect_camera(parse_camera("0.5 0.75 0.5 0.25 0\n640 480\nfull\n640 480\n", "f"),
                {320, 360, 319.5, 119.5, 640, 480}, {});
}

TEST(CameraFile, WithoutASize) {
  for (const char* text : {"707.5 0 601.5\n0 708.5 183.5\n0 0 1\n", "707.5 0 601.5 0 708.5 183.5 0 0 1",
                           "707.5 708.5 601.5 183.5", "707.5 708.5 601.5 183.5 0 0 0 0 0.0",
                           "K: [707.5, 0, 601.5, 0, 708.5, 183.5, 0, 0, 1]"}) {
    const CameraText read = parse_camera_text(text, "f");
    EXPECT_FALSE(read.has_size()) << text;
    expect_camera(read.camera, {707.5, 708.5, 601.5, 183.5, 0, 0}, {});
  }
}

// sensor_msgs/CameraInfo: matrix and size are those of the whole sensor.
TEST(CameraFile, FollowsRegionAndBinning) {
  const std::string whole = "width: 640\nheight: 480\nK: [500, 0, 320, 0, 501, 240, 0, 0, 1]\n";
  const CameraText same = parse_camera_text(whole + "roi: {x_offset: 0, width: 640, height: 480}\n", "f");
  EXPECT_EQ(same.note, "");
  expect_camera(same.camera, {500, 501, 320, 240, 640, 480}, {});
  const CameraText cut =
      parse_camera_text(whole + "roi: {x_offset: 100, y_offset: 40, width: 400, height: 400}\n", "f");
  EXPECT_EQ(cut.note, "of 640x480 the region 400x400 at 100, 40 (roi)");
  expect_camera(cut.camera, {500, 501, 220, 200, 400, 400}, {});
  const CameraText binned = parse_camera_text(whole + "binning_x: 2\nbinning_y: 2\n", "f");
  expect_camera(binned.camera, {250, 250.5, 159.75, 119.75, 320, 240}, {});
}

TEST(CameraFile, SaysWhichOfTwoCamerasItTook) {
  const std::string matrix = ": [500, 0, 320, 0, 501, 240, 0, 0, 1]\n";
  const CameraText stereo = parse_camera_text("M1" + matrix + "M2" + matrix, "f");
  EXPECT_THAT(stereo.note, HasSubstr("first camera of a stereo pair"));
  EXPECT_THAT(stereo.doubt, HasSubstr("write M2 and D2"));
  const CameraText turned = parse_camera_text("K" + matrix + "R: [0, 1, 0, -1, 0, 0, 0, 0, 1]\n", "f");
  EXPECT_THAT(turned.note, HasSubstr("for raw images"));
  EXPECT_EQ(parse_camera_text("K" + matrix + "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n", "f").note, "");
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
        Bad{"too_few", "1 2 3 4 5 6 7", "has 7 fields instead of 10"},
        Bad{"no_height", "20 20 12 8 0 0 0 0 24", "has 9 fields instead of 10"},
        Bad{"no_size", "20 20 12 8", "image size is missing"},
        Bad{"decimal_commas", "20,5 20,5 12 8 0 0 0 0 24 16", "has commas"},
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
        Bad{"yaml_omni", "resolution: [640, 480]\nintrinsics: [500, 500, 320, 240]\ncamera_model: omni\n",
            "intrinsics holds 4 numbers; write xi, fx, fy, cx, cy"},
        Bad{"yaml_binning", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nbinning_x: 2\n",
            "binning needs the image size"},
        Bad{"yaml_roi", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nroi:\n  x_offset: 300\n",
            "the region of interest (roi) is not within the image"},
        Bad{"yaml_rectified_roi", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nroi:\n  do_rectify: true\n",
            "line 3: roi.do_rectify 'true': the images are rectified"},
        Bad{"yaml_single_cx", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\ncx: 320\n",
            "unknown key 'cx'; write camera_matrix: [fx, 0, cx"},
        Bad{"yaml_single_k1", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nk1: 0.1\n",
            "write distortion_coefficients"},
        Bad{"yaml_mount_group", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nmount:\n  pitch: 20\n",
            "unknown key 'mount.pitch'; write mount: [roll, pitch, yaw] in degrees"},
        Bad{"exchanged_sides", "500 500 400 240 0 0 0 0 300 640",
            "the matrix is one of 640x300 images, the size is 300x640; exchange width and height"},
        Bad{"yaml_unknown_key", "image_widht: 640\ncamera_matrix: [1]\n",
            "line 1: unknown key 'image_widht'; did you mean 'image_width'?"},
        Bad{"yaml_unknown_far", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\nvignetting: 0.3\n",
            "unknown key 'vignetting'; remove it"},
        Bad{"yaml_unknown_model", "resolution: [640, 480]\ndistortion_model: plum_bob\n",
            "'plum_bob' is not supported; did you mean 'plumb_bob'?"},
        Bad{"yaml_two_matrices", "K: [1]\ncamera_matrix: [1]\n", "mean the same"},
        Bad{"yaml_empty_distortion", "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\ndist_coeff:\n", "has no value"},
        Bad{"yaml_loose_item", "width: 5\n- 5\n", "a list item belongs to no key"},
        Bad{"yaml_two_documents",
            "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\n---\nK: [600, 0, 320, 0, 501, 240, 0, 0, 1]\n",
            "document 2 is another calibration"},
        Bad{"kalibr_without_intrinsics", "cam0:\n  T_cam_imu:\n  - [1, 0]\n  - [0, 1]\n",
            "camera_matrix is missing"},
        Bad{"other_yaml", "FeatureDetector:\n  Type: STAR\n", "is not a camera file of a known form"},
        Bad{"kitti", "P0: 707 0 601 0 0 707 183 0 0 0 1 0\nP1: 707 0 601 -3 0 707 183 0 0 0 1 0\n",
            "is KITTI's calib.txt"},
        Bad{"ost_stereo",
            "[image]\nwidth\n640\nheight\n480\ncamera matrix\n5 0 1\n0 5 1\n0 0 1\ncamera matrix\n",
            "several cameras"},
        Bad{"ost_torn", "[image]\nwidth\n640\nheight\n480\ncamera matrix\n5 0 1\n", "ends too early"},
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
