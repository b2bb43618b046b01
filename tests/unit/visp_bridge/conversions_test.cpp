// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/conversions.h"

#include <gtest/gtest.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpPixelMeterConversion.h>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

GrayImage ramp(int width, int height) {
  GrayImage image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.pixels.push_back(uint8_t(i * 7));
  return image;
}

TEST(VispImages, SharingMakesNoCopy) {
  GrayImage image = ramp(7, 5);
  vpImage<unsigned char> shared = share_with_visp(image);
  EXPECT_EQ(shared.bitmap, image.pixels.data());
  EXPECT_EQ(shared.getWidth(), 7u);
  EXPECT_EQ(shared.getHeight(), 5u);
  EXPECT_EQ(shared[3][2], image.view().at(2, 3));
  shared[4][6] = 99;
  EXPECT_EQ(image.view().at(6, 4), 99);
  const ImageView<uint8_t> view = view_of(shared);
  EXPECT_EQ(view.data, image.pixels.data());
  EXPECT_EQ(view.at(6, 4), 99);
}

TEST(VispImages, ACopyOwnsItsPixels) {
  const GrayImage image = ramp(7, 5);
  const vpImage<unsigned char> copy = to_visp(image.view());
  EXPECT_NE(copy.bitmap, image.pixels.data());
  EXPECT_EQ(to_gray_image(copy).pixels, image.pixels);
  EXPECT_EQ(to_gray_image(copy).width, 7);
}

TEST(VispImages, RowsWithAStrideAreCopiedWithoutTheirPadding) {
  const GrayImage image = ramp(10, 6);
  const ImageView<uint8_t> part{image.pixels.data() + 2 * 10 + 3, 4, 3, 10};  // 4x3 pixels at (3, 2)
  const vpImage<unsigned char> copy = to_visp(part);
  ASSERT_EQ(copy.getSize(), 12u);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(copy[y][x], image.view().at(x + 3, y + 2));
}

TEST(VispCamera, ProjectsToTheSamePixel) {
  const Pinhole pinhole{517.3, 516.5, 318.6, 255.3, 640, 480};
  const Eigen::Vector3d p(0.3, -0.2, 1.7);
  double u = 0, v = 0;
  vpMeterPixelConversion::convertPoint(to_visp(pinhole), p.x() / p.z(), p.y() / p.z(), u, v);
  EXPECT_NEAR(u, pinhole.project(p).x(), 1e-12);
  EXPECT_NEAR(v, pinhole.project(p).y(), 1e-12);
}

TEST(VispCamera, IsUnchangedAfterARoundTrip) {
  const Pinhole pinhole{517.3, 516.5, 318.6, 255.3, 640, 480};
  const Pinhole back = to_pinhole(to_visp(pinhole), 640, 480);
  EXPECT_EQ(back.fx, pinhole.fx);
  EXPECT_EQ(back.fy, pinhole.fy);
  EXPECT_EQ(back.cx, pinhole.cx);
  EXPECT_EQ(back.cy, pinhole.cy);
  EXPECT_EQ(back.width, 640);
  EXPECT_EQ(back.height, 480);
}

TEST(VispCamera, DistortionAndInvalidValuesAreRefused) {
  EXPECT_THROW(to_pinhole(vpCameraParameters(500, 500, 320, 240, 0.1, -0.1), 640, 480), InputError);
  EXPECT_THROW(to_pinhole(vpCameraParameters(500, 500, 320, 240), 300, 480), InputError);
}

TEST(VispCamera, OneRadialCoefficientIsConvertedBothWays) {
  const Camera camera{{517.3, 516.5, 318.6, 255.3, 640, 480}, {-0.08, 0, 0, 0, 0}};
  const vpCameraParameters visp = to_visp(camera, "camera");
  const Camera back = to_camera(visp, 640, 480);
  EXPECT_EQ(back.distortion().k1, -0.08);
  EXPECT_EQ(back.pinhole().fx, 517.3);
  for (const Eigen::Vector2d& x : {Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(-0.5, 0.4)}) {
    double u = 0, v = 0, x_back = 0, y_back = 0;
    vpMeterPixelConversion::convertPoint(visp, x.x(), x.y(), u, v);
    const Eigen::Vector2d px = camera.project({x.x(), x.y(), 1}).value();
    EXPECT_NEAR(u, px.x(), 1e-9);
    EXPECT_NEAR(v, px.y(), 1e-9);
    vpPixelMeterConversion::convertPoint(visp, u, v, x_back,
                                         y_back);  // by kdu, which one coefficient can only fit
    EXPECT_NEAR(x_back, x.x(), 2e-3);
    EXPECT_NEAR(y_back, x.y(), 2e-3);
  }
  EXPECT_EQ(to_visp(Camera{camera.pinhole(), {}}, "camera").get_projModel(),
            vpCameraParameters::perspectiveProjWithoutDistortion);
}

TEST(VispCamera, ModelsUnknownToViSPAreRefused) {
  EXPECT_THROW(to_visp(Camera{{500, 500, 320, 240, 640, 480}, {0.1, -0.2, 0, 0, 0}}, "camera.txt"),
               InputError);
  Camera omni({500, 500, 320, 240, 640, 480});
  omni.model = OmniModel{{500, 500, 320, 240}, 0.8, {}};
  EXPECT_THROW(to_visp(omni, "camera.txt"), InputError);
}

TEST(VispCamera, AFisheyeStaysOne) {
  vpCameraParameters fisheye;
  fisheye.initProjWithKannalaBrandtDistortion(500, 500, 320, 240, {0.1, 0, 0, 0});
  const Camera camera = to_camera(fisheye, 640, 480);
  ASSERT_STREQ(to_string(camera.model), "kannala_brandt");
  EXPECT_EQ(std::get<KannalaBrandtModel>(camera.model).k1, 0.1);
  EXPECT_EQ(to_visp(camera, "here").getKannalaBrandtDistortionCoefficients(),
            fisheye.getKannalaBrandtDistortionCoefficients());
}

TEST(VispImages, ColourBecomesGrayInPlace) {
  vpImage<vpRGBa> colour(3, 5, vpRGBa(10, 20, 30));
  colour[2][4] = vpRGBa(255, 255, 255);
  const GrayImage gray = to_gray_image(colour);
  ASSERT_EQ(gray.width, 5);
  ASSERT_EQ(gray.height, 3);
  EXPECT_NEAR(gray.view().at(0, 0), 0.2126 * 10 + 0.7152 * 20 + 0.0722 * 30, 1.01);
  EXPECT_GE(gray.view().at(4, 2), 254);
}

TEST(VispMotion, MapsPointsEquallyAndIsUnchangedAfterARoundTrip) {
  Vector6d xi;
  xi << 1, -2, 3, 0.4, 1.9, -0.7;
  const SE3 T_a_b = SE3::exp(xi);
  const vpHomogeneousMatrix aMb = to_visp(T_a_b);
  const vpColVector p_b{0.3, -0.1, 4.0, 1.0};
  const vpColVector p_a = aMb * p_b;
  const Eigen::Vector3d expected = T_a_b * Eigen::Vector3d(0.3, -0.1, 4.0);
  for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(p_a[i], expected[i], 1e-14);
  EXPECT_LT((to_se3(aMb).matrix() - T_a_b.matrix()).norm(), 1e-14);
  EXPECT_LT((to_se3(aMb.inverse()).matrix() - T_a_b.inverse().matrix()).norm(), 1e-14);
  EXPECT_TRUE(aMb.isAnHomogeneousMatrix());
}

TEST(VispMotion, ARotationThatHasDriftedIsNormalised) {
  vpHomogeneousMatrix aMb;
  aMb[0][0] = 1.001;
  EXPECT_NEAR(to_se3(aMb).R().determinant(), 1.0, 1e-14);
}

}  // namespace
}  // namespace edgevo
