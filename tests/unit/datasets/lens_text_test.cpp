// SPDX-License-Identifier: BSD-3-Clause
// Lenses by name and coefficients, and edgevo's own camera file, which has a name for each.
#include "lens_text.h"

#include <opencv2/core.hpp>

#include "camera_doubt.h"
#include "camera_fit.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "support/camera_examples.h"
#include "unit/datasets/same_rays.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::CameraExample;
using test::error_of;
using test::expect_same_rays;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class EveryLens : public ::testing::TestWithParam<CameraExample> {};

INSTANTIATE_TEST_SUITE_P(All, EveryLens, ::testing::ValuesIn(test::camera_examples()), test::name_of);

TEST_P(EveryLens, IsTheSameFromNameAndCoefficients) {
  Camera back = GetParam().camera;
  back.model = model_of(stated_lens(back.model), "f");
  EXPECT_STREQ(to_string(back.model), to_string(GetParam().camera.model));
  expect_same_rays(back, GetParam().camera);
}

TEST_P(EveryLens, IsReadBackFromTheCameraFile) {
  const std::string text = camera_yaml(GetParam().camera, "a comment");
  const Camera back = parse_camera(text, "f");
  EXPECT_STREQ(to_string(back.model), to_string(GetParam().camera.model)) << text;
  expect_same_rays(back, GetParam().camera);
}

TEST_P(EveryLens, IsReadByOpenCvAsAMatrixAndCoefficients) {
  test::TempFolder folder;
  test::write_text(folder / "camera.yaml", camera_yaml(GetParam().camera, ""));
  const cv::FileStorage file(folder / "camera.yaml", cv::FileStorage::READ);
  cv::Mat K, D;
  file["camera_matrix"] >> K;
  file["distortion_coefficients"] >> D;
  ASSERT_EQ(K.size(), cv::Size(3, 3));
  EXPECT_NEAR(K.at<double>(0, 0), stated_lens(GetParam().camera.model).intrinsics.fx, 1e-9);
  EXPECT_GT(D.total(), 0u);
}

// A point keeps its ray, turned about the axis.
TEST_P(EveryLens, TurnsWithTheImages) {
  const Camera& camera = GetParam().camera;
  const Camera turned = turned_camera(camera, 1);
  for (const Eigen::Vector3d& ray : {Eigen::Vector3d(0.1, 0.05, 1), Eigen::Vector3d(-0.2, 0.1, 1)}) {
    const auto px = camera.project(ray);
    const auto moved = turned.project({-ray.y(), ray.x(), ray.z()});
    ASSERT_TRUE(px && moved);
    EXPECT_LT((*moved - Eigen::Vector2d(camera.height - 1 - px->y(), px->x())).norm(), 1e-9);
  }
}

TEST_P(EveryLens, ScalesWithTheImages) {
  const Camera& camera = GetParam().camera;
  const Camera small = scaled_camera(camera, camera.width / 2, camera.height / 2);
  const Eigen::Vector3d ray(0.1, -0.15, 1);
  const Eigen::Vector2d px = *camera.project(ray);
  EXPECT_LT((*small.project(ray) - Eigen::Vector2d(px.x() / 2 - 0.25, px.y() / 2 - 0.25)).norm(), 1e-9);
}

// ---- names ----

constexpr const char* kSize = "image_width: 640\nimage_height: 480\n";
constexpr const char* kMatrix = "camera_matrix: [250, 0, 321, 0, 251, 238, 0, 0, 1]\n";

Camera camera_of(const CameraModel& model) {
  Camera camera;
  camera.model = model;
  camera.width = 640, camera.height = 480;
  return camera;
}

struct Named {
  const char* test;
  const char* lens;
  Camera camera;
};

class NamedLens : public ::testing::TestWithParam<Named> {};

TEST_P(NamedLens, IsRead) {
  expect_same_rays(parse_camera(std::string(kSize) + kMatrix + GetParam().lens, "f"), GetParam().camera);
}

const Intrinsics kStated{250, 251, 321, 238};
const RationalDistortion kRational{{3.1, 1.4, 2e-4, -1e-4, 0.05}, 3.4, 2.2, 0.26, 0, 0, 0, 0};

// Focal lengths are those of the formula, as each paper has them.
INSTANTIATE_TEST_SUITE_P(
    All, NamedLens,
    ::testing::Values(
        Named{"equidistant", "distortion_model: equidistant\nD: [0.01, 0.02, -0.03, 0.004]\n",
              camera_of(KannalaBrandtModel{kStated, 0.01, 0.02, -0.03, 0.004})},
        Named{"equidistant_with_a_zero", "distortion_model: equidistant\nD: [0.01, 0.02, -0.03, 0.004, 0]\n",
              camera_of(KannalaBrandtModel{kStated, 0.01, 0.02, -0.03, 0.004})},
        Named{"kannala_brandt", "distortion_model: kannala_brandt\nD: [0, 0, 0, 0]\n",
              camera_of(KannalaBrandtModel{kStated, 0, 0, 0, 0})},
        Named{"opencv_fisheye", "fisheye_model: 1\ndistortion_coefficients: [0.01, 0.02, -0.03, 0.004]\n",
              camera_of(KannalaBrandtModel{kStated, 0.01, 0.02, -0.03, 0.004})},
        Named{"opencv_omnidir",
              "xi: !!opencv-matrix\n   rows: 1\n   cols: 1\n   dt: d\n   data: [ 1.5 ]\n"
              "distortion_coefficients: [-0.1, 0.2, 0.001, -0.0005]\n",
              camera_of(OmniModel{{100, 100.4, 321, 238}, 1.5, {-0.1, 0.2, 1e-3, -5e-4, 0}})},
        Named{"omni", "distortion_model: omni\nD: [1.5, -0.1, 0.2, 0.001, -0.0005]\n",
              camera_of(OmniModel{{100, 100.4, 321, 238}, 1.5, {-0.1, 0.2, 1e-3, -5e-4, 0}})},
        Named{"double_sphere", "distortion_model: double_sphere\nD: [0.25, 0.6]\n",
              camera_of(DoubleSphereModel{{200, 200.8, 321, 238}, 0.25, 0.6})},
        Named{"eucm", "distortion_model: eucm\nD: [0.6, 1.1]\n",
              camera_of(ExtendedUnifiedModel{kStated, 0.6, 1.1})},
        Named{"ucm", "distortion_model: ucm\nD: [0.6]\n", camera_of(ExtendedUnifiedModel{kStated, 0.6, 1})},
        Named{"fov_of_a_right_angle", "distortion_model: fov\nD: [1.5707963267948966]\n",
              camera_of(FovModel{{250 * 4 / M_PI, 251 * 4 / M_PI, 321, 238}, M_PI / 2})},
        Named{"fov_of_zero", "distortion_model: fov\nD: [0]\n", camera_of(PinholeModel{kStated})},
        Named{"rational",
              "distortion_model: rational_polynomial\nD: [3.1, 1.4, 2e-4, -1e-4, 0.05, 3.4, 2.2, "
              "0.26]\n",
              camera_of(RationalModel{kStated, kRational})},
        Named{"eight_without_a_name", "D: [3.1, 1.4, 2e-4, -1e-4, 0.05, 3.4, 2.2, 0.26]\n",
              camera_of(RationalModel{kStated, kRational})},
        Named{"fourteen_without_tilt", "D: [3.1, 1.4, 2e-4, -1e-4, 0.05, 3.4, 2.2, 0.26, 0, 0, 0, 0, 0, 0]\n",
              camera_of(RationalModel{kStated, kRational})},
        Named{"thin_prism", "D: [0.1, 0, 0, 0, 0, 0, 0, 0, 0.001, 0.002, 0.003, 0.004]\n",
              camera_of(RationalModel{kStated, {{0.1, 0, 0, 0, 0}, 0, 0, 0, 0.001, 0.002, 0.003, 0.004}})}),
    [](const auto& test) { return std::string(test.param.test); });

struct BadLens {
  const char* test;
  const char* lens;
  const char* message;
};

class RefusedLens : public ::testing::TestWithParam<BadLens> {};

TEST_P(RefusedLens, IsReportedInOneLine) {
  EXPECT_THAT(error_of([] { parse_camera(std::string(kSize) + kMatrix + GetParam().lens, "f"); }),
              HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, RefusedLens,
    ::testing::Values(
        BadLens{"too_few", "distortion_model: equidistant\nD: [0.1, 0.2]\n",
                "the lens equidistant has 2 coefficients; write k1, k2, k3, k4"},
        BadLens{"none_given", "distortion_model: double_sphere\n", "has 0 coefficients; write xi, alpha"},
        BadLens{"too_many", "distortion_model: plumb_bob\nD: [1, 1, 1, 1, 1, 1, 1, 1]\n",
                "the lens plumb_bob has 8 coefficients; write k1, k2, p1, p2, k3"},
        BadLens{"seven", "D: [1, 1, 1, 1, 1, 1, 1]\n", "has 7 coefficients"},
        BadLens{"tilted", "D: [1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0.1, 0]\n", "the sensor is tilted"},
        BadLens{"none", "distortion_model: none\nD: [0.1, 0, 0, 0]\n", "has no distortion, but coefficients"},
        BadLens{"scaramuzza", "distortion_model: scaramuzza\n",
                "'scaramuzza' is not supported; calibrate as"},
        BadLens{"slip", "distortion_model: equidistand\n", "did you mean 'equidistant'?"},
        BadLens{"xi_of_another", "distortion_model: plumb_bob\nxi: 1.2\nD: [0, 0, 0, 0]\n",
                "xi does not go with distortion_model plumb_bob"},
        BadLens{"fisheye_of_another", "distortion_model: plumb_bob\nfisheye_model: 1\nD: [0, 0, 0, 0]\n",
                "fisheye_model 1 does not go with distortion_model plumb_bob"},
        BadLens{"fisheye_neither", "fisheye_model: 2\nD: [0, 0, 0, 0]\n", "'2' is neither 0 nor 1"},
        BadLens{"pair", "camera_model: ds\ndistortion_model: radtan\nD: [0, 0, 0, 0]\n",
                "distortion_model plumb_bob does not go with camera_model double_sphere"},
        BadLens{"xi_of_minus_one", "distortion_model: double_sphere\nD: [-1, 0.5]\n", "xi is not above -1"},
        BadLens{"alpha", "distortion_model: eucm\nD: [1.5, 1]\n", "alpha must lie between 0 and 1"},
        BadLens{"omega", "distortion_model: fov\nD: [4]\n", "angle of the FOV lens"}),
    [](const auto& test) { return std::string(test.param.test); });

// ---- plausibility ----

TEST(LensDoubt, FisheyeCamerasAreNotDoubted) {
  using test::wide_camera;
  for (const Camera& camera :
       {wide_camera(KannalaBrandtModel{{}, 3.4e-3, 7.6e-4, -9.9e-4, 2.1e-4}, 190),
        wide_camera(DoubleSphereModel{{}, -0.18, 0.59}, 190),
        wide_camera(OmniModel{{}, 1.6, {-0.1, 0.2, 1e-3, -5e-4, 0}}, 230),
        wide_camera(FovModel{{}, 0.93}, 280), wide_camera(RationalModel{{}, kRational}, 250)})
    EXPECT_EQ(doubt_about(camera), "") << to_string(camera.model);
}

TEST(LensDoubt, AFisheyeThatEndsWithinTheImageIsDoubted) {
  EXPECT_THAT(doubt_about(test::wide_camera(KannalaBrandtModel{{}, -0.13, 0.02, -0.01, 0.001}, 100)),
              HasSubstr("The formula of the lens ends at"));
}

}  // namespace
}  // namespace edgevo
