// SPDX-License-Identifier: BSD-3-Clause
// Output of camera_yaml() as read by parse_camera(), OpenCV and MRPT. (yaml-cpp, under ROS's parser, was
// tried by hand: README.)
#include <mrpt/containers/yaml.h>
#include <mrpt/img/TCamera.h>

#include <opencv2/core.hpp>
#include <sstream>

#include "edgevo/datasets/camera_file.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

// Numbers with many digits, whole numbers and an exponent: all must come back as they were.
Camera odd_camera() {
  Camera camera;
  camera.set_pinhole({517.306408, 516, 318.643040, 1.0 / 3 + 255, 640, 480});
  camera.set_distortion({0.262383, -0.953104, -0.005358, 1.5e-17, 2});
  return camera;
}

std::vector<double> lens(const Camera& c) {
  const Distortion d = c.distortion();
  return {c.pinhole().fx, c.pinhole().fy, c.pinhole().cx, c.pinhole().cy, d.k1, d.k2, d.p1, d.p2, d.k3};
}

class CameraYaml : public ::testing::Test {
 protected:
  CameraYaml() {
    test::write_text(path, camera_yaml(odd_camera(), "a comment: with a colon\nand [brackets"));
  }
  test::TempFolder folder;
  std::string path = folder.path() + "/camera.yaml";
};

TEST_F(CameraYaml, IsReadBackToTheLastBit) {
  const Camera back = read_camera_file(path);
  EXPECT_EQ(lens(back), lens(odd_camera()));
  EXPECT_EQ(back.pinhole().width, 640);
  EXPECT_EQ(back.pinhole().height, 480);
}

TEST_F(CameraYaml, IsReadByOpenCv) {
  const cv::FileStorage file(path, cv::FileStorage::READ);
  ASSERT_TRUE(file.isOpened());
  cv::Mat K, D, P;
  file["camera_matrix"] >> K;
  file["distortion_coefficients"] >> D;
  file["projection_matrix"] >> P;
  ASSERT_EQ(K.size(), cv::Size(3, 3));
  ASSERT_EQ(D.size(), cv::Size(5, 1));
  ASSERT_EQ(P.size(), cv::Size(4, 3));
  ASSERT_EQ(K.type(), CV_64F);
  const std::vector<double> expected = lens(odd_camera());
  const std::vector<double> found{K.at<double>(0, 0), K.at<double>(1, 1), K.at<double>(0, 2),
                                  K.at<double>(1, 2), D.at<double>(0),    D.at<double>(1),
                                  D.at<double>(2),    D.at<double>(3),    D.at<double>(4)};
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
  EXPECT_EQ(int(file["image_width"]), 640);
  EXPECT_EQ(int(file["image_height"]), 480);
}

TEST_F(CameraYaml, IsReadByMrpt) {
  const auto camera = mrpt::img::TCamera::FromYAML(mrpt::containers::yaml::FromFile(path));
  const std::vector<double> found{camera.fx(), camera.fy(), camera.cx(), camera.cy(), camera.k1(),
                                  camera.k2(), camera.p1(), camera.p2(), camera.k3()};
  EXPECT_EQ(found, lens(odd_camera()));
  EXPECT_EQ(camera.ncols, 640u);
  EXPECT_EQ(camera.nrows, 480u);
  EXPECT_EQ(camera.distortion, mrpt::img::DistortionModel::plumb_bob);
}

// The YAML of MRPT itself, which has a name for each lens and eight coefficients for plumb-bob.
Camera read_from_mrpt(const mrpt::img::TCamera& camera) {
  std::ostringstream text;
  text << camera.asYAML();
  return parse_camera(text.str(), "of MRPT");
}

TEST(YamlOfMrpt, IsReadWithPlumbBobAndFisheye) {
  mrpt::img::TCamera written;
  written.ncols = 640, written.nrows = 480;
  written.setIntrinsicParamsFromValues(500, 501, 320, 240);
  written.setDistortionPlumbBob(-0.1, 0.02, 0.001, 0.002, 0.003);
  EXPECT_EQ(lens(read_from_mrpt(written)),
            (std::vector<double>{500, 501, 320, 240, -0.1, 0.02, 0.001, 0.002, 0.003}));
  written.setDistortionKannalaBrandt(0.01, 0.02, 0.03, 0.04);
  const Camera fisheye = read_from_mrpt(written);
  const auto& model = std::get<KannalaBrandtModel>(fisheye.model);
  EXPECT_EQ(model.k1, 0.01);
  EXPECT_EQ(model.k4, 0.04);
}

}  // namespace
}  // namespace edgevo
