// SPDX-License-Identifier: BSD-3-Clause
// Camera files in the formats of other programs, read back, and by OpenCV.
#include <opencv2/core.hpp>

#include "edgevo/datasets/camera_file.h"
#include "support/camera_examples.h"
#include "unit/datasets/same_rays.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::error_of;
using test::wide_camera;
using ::testing::HasSubstr;

Camera plumb_bob() { return wide_camera(PlumbBobModel{{}, {0.1, -0.02, 0.001, 0.002, 0}}, 500); }
Camera plumb_bob_k3() { return wide_camera(PlumbBobModel{{}, {0.1, -0.02, 0.001, 0.002, 0.3}}, 500); }
Camera fisheye() { return wide_camera(KannalaBrandtModel{{}, 3.4e-3, 7.6e-4, -9.9e-4, 2.1e-4}, 190); }
Camera omni() { return wide_camera(OmniModel{{}, 1.6, {-0.1, 0.2, 1e-3, -5e-4, 0}}, 230); }
Camera rational() {
  return wide_camera(RationalModel{{}, {{3.1, 1.4, 2e-4, -1e-4, 0.05}, 3.4, 2.2, 0.26, 0, 0, 0, 0}}, 250);
}

struct Written {
  const char* format;
  std::vector<Camera> cameras;
};

class CameraFileText : public ::testing::TestWithParam<Written> {};

TEST_P(CameraFileText, IsReadBackWithTheSameRays) {
  for (const Camera& camera : GetParam().cameras) {
    const std::string text = camera_file_text(camera, GetParam().format, "made by a test\nof two lines: [");
    test::expect_same_rays(parse_camera(text, "f"), camera);
    EXPECT_STREQ(to_string(parse_camera(text, "f").model), to_string(camera.model)) << text;
  }
}

const Camera kPinhole = wide_camera(PinholeModel{}, 500), kFov = wide_camera(FovModel{{}, 0.93}, 280),
             kEucm = wide_camera(ExtendedUnifiedModel{{}, 0.57, 1.18}, 220),
             kDoubleSphere = wide_camera(DoubleSphereModel{{}, -0.18, 0.59}, 190);

INSTANTIATE_TEST_SUITE_P(
    All, CameraFileText,
    ::testing::Values(
        Written{"ros", {kPinhole, plumb_bob(), plumb_bob_k3(), rational(), fisheye()}},
        Written{"kalibr", {kPinhole, plumb_bob(), fisheye(), kFov, kEucm, kDoubleSphere, omni()}},
        Written{"orb_slam", {kPinhole, plumb_bob(), plumb_bob_k3(), fisheye()}},
        Written{"opencv", {kPinhole, plumb_bob(), plumb_bob_k3(), rational(), fisheye(), omni()}}),
    [](const auto& test) { return std::string(test.param.format); });

TEST(CameraFileTexts, RefuseWhatTheProgramDoesNotHave) {
  EXPECT_THAT(error_of([] { camera_file_text(kDoubleSphere, "ros", ""); }),
              HasSubstr("ROS has no lens double_sphere"));
  EXPECT_THAT(error_of([] { camera_file_text(rational(), "kalibr", ""); }),
              HasSubstr("Kalibr has no lens rational_polynomial"));
  EXPECT_THAT(error_of([] { camera_file_text(plumb_bob_k3(), "kalibr", ""); }), HasSubstr("has no k3"));
  EXPECT_THAT(error_of([] { camera_file_text(rational(), "orb_slam", ""); }), HasSubstr("ORB-SLAM has no"));
  for (const Camera& camera : {kFov, kEucm, kDoubleSphere})
    EXPECT_THAT(error_of([&] { camera_file_text(camera, "opencv", ""); }), HasSubstr("OpenCV has no lens"));
  EXPECT_THAT(error_of([] { camera_file_text(kPinhole, "matlab", ""); }),
              HasSubstr("choose one of ros, kalibr, orb_slam, opencv"));
}

TEST(CameraFileTexts, OpenCvReadsItsOwn) {
  test::TempFolder folder;
  test::write_text(folder / "c.yaml", camera_file_text(omni(), "opencv", "a comment"));
  const cv::FileStorage file(folder / "c.yaml", cv::FileStorage::READ);
  cv::Mat K, D;
  file["camera_matrix"] >> K;
  file["distortion_coefficients"] >> D;
  ASSERT_EQ(K.size(), cv::Size(3, 3));
  EXPECT_NEAR(K.at<double>(0, 0), 230 * 2.6, 1e-9);
  EXPECT_EQ(D.total(), 4u);
  EXPECT_NEAR(double(file["xi"]), 1.6, 1e-12);
  test::write_text(folder / "o.yaml", camera_file_text(fisheye(), "orb_slam", ""));
  const cv::FileStorage settings(folder / "o.yaml", cv::FileStorage::READ);
  EXPECT_TRUE(settings["Camera.fx"].isReal());
  EXPECT_EQ(std::string(settings["Camera.type"]), "KannalaBrandt8");
}

}  // namespace
}  // namespace edgevo
