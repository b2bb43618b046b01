// SPDX-License-Identifier: BSD-3-Clause
// The camera model, against OpenCV with the calibration of TUM's fr1 sequences.
#include "edgevo/core/camera.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/rectification.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

Camera fr1() {
  return {{517.306408, 516.469215, 318.643040, 255.313989, 640, 480},
          {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}};
}

cv::Mat K_of(const Pinhole& p) { return (cv::Mat_<double>(3, 3) << p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1); }
cv::Mat D_of(const Distortion& d) { return (cv::Mat_<double>(1, 5) << d.k1, d.k2, d.p1, d.p2, d.k3); }

TEST(Camera, DistortsAsOpenCvDoes) {
  const Camera c = fr1();
  for (double v = 0; v < 480; v += 37)
    for (double u = 0; u < 640; u += 37) {
      const Eigen::Vector3d ray = c.pinhole().ray({u, v});
      std::vector<cv::Point2d> projected;
      cv::projectPoints(std::vector<cv::Point3d>{{ray.x(), ray.y(), 1.0}}, cv::Vec3d(), cv::Vec3d(),
                        K_of(c.pinhole()), D_of(c.distortion()), projected);
      const auto px = c.project(ray);
      ASSERT_TRUE(px);
      EXPECT_NEAR(px->x(), projected[0].x, 1e-9);
      EXPECT_NEAR(px->y(), projected[0].y, 1e-9);
    }
}

TEST(Camera, UndistortsAsOpenCvDoes) {
  const Camera c = fr1();
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 1000, 1e-14);
  for (double v = 0; v < 480; v += 37)
    for (double u = 0; u < 640; u += 37) {
      std::vector<cv::Point2d> theirs;
      cv::undistortPoints(std::vector<cv::Point2d>{{u, v}}, theirs, K_of(c.pinhole()), D_of(c.distortion()),
                          cv::noArray(), cv::noArray(), until);
      const auto ours = c.unproject({u, v});
      ASSERT_TRUE(ours);
      EXPECT_NEAR(ours->x() / ours->z(), theirs[0].x, 1e-8) << u << " " << v;
      EXPECT_NEAR(ours->y() / ours->z(), theirs[0].y, 1e-8) << u << " " << v;
    }
}

TEST(Camera, UnprojectFailsWhereTheModelFoldsOver) {
  // r (1 - r^2/2) grows only up to r = 0.816, where it is 0.544.
  const Camera c({100, 100, 100, 80, 200, 160}, {-0.5, 0, 0, 0, 0});
  EXPECT_TRUE(c.unproject({150, 80}));
  EXPECT_FALSE(c.unproject({160, 80}));
  EXPECT_NEAR(std::tan(c.max_angle()), std::sqrt((1 - 1e-3) / 1.5), 1e-12);
}

TEST(Camera, WithoutDistortionItIsAPinhole) {
  EXPECT_TRUE(fr1().has_distortion());
  Camera c = fr1();
  c.set_distortion({});
  EXPECT_FALSE(c.has_distortion());
  EXPECT_TRUE(c.distortion().is_zero());
  const Eigen::Vector3d ray(0.3, -0.2, 1);
  EXPECT_EQ(c.project(ray).value(), c.pinhole().project(ray));
}

TEST(Camera, AnotherPinholeKeepsTheLens) {
  Camera c = fr1();
  c.set_pinhole({258, 258, 159, 127, 320, 240});
  EXPECT_EQ(c.distortion().k1, fr1().distortion().k1);
  EXPECT_EQ(c.width, 320);
  EXPECT_EQ(c.pinhole().fx, 258);
}

TEST(RectificationMaps, AreThoseOfOpenCv) {
  const Camera c = fr1();
  const RectificationMaps maps = Rectification(c).maps();
  ASSERT_EQ(maps.x.size(), 640u * 480u);
  ASSERT_EQ(maps.y.size(), 640u * 480u);
  cv::Mat map_x, map_y;
  cv::initUndistortRectifyMap(K_of(c.pinhole()), D_of(c.distortion()), cv::noArray(), K_of(c.pinhole()),
                              cv::Size(640, 480), CV_32FC1, map_x, map_y);
  double worst = 0;
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u)
      worst = std::max({worst, std::abs(double(maps.x[size_t(v * 640 + u)] - map_x.at<float>(v, u))),
                        std::abs(double(maps.y[size_t(v * 640 + u)] - map_y.at<float>(v, u)))});
  EXPECT_LT(worst, 2e-4);  // floats of up to 640
}

TEST(Pinhole, RayAndProjectionAreInverse) {
  const Pinhole p = fr1().pinhole();
  const Eigen::Vector2d px(123.4, 345.6);
  EXPECT_LT((p.project(7.5 * p.ray(px)) - px).norm(), 1e-12);
  EXPECT_EQ(p.project({0, 0, 2}), Eigen::Vector2d(p.cx, p.cy));
}

TEST(Pinhole, ALevelHalvesCoordinatesAndRoundsSizesUp) {
  Pinhole p{700, 710, 600.5, 180.25, 1241, 375};
  const Pinhole level = p.at_level(2);
  EXPECT_EQ(level.width, 311);  // 1241 -> 621 -> 311, as cv::pyrDown
  EXPECT_EQ(level.height, 94);  // 375 -> 188 -> 94
  const Eigen::Vector3d point(0.7, -0.3, 5);
  EXPECT_LT((level.project(point) - p.project(point) / 4).norm(), 1e-12);
  cv::Mat image(375, 1241, CV_8U, cv::Scalar(0)), half, quarter;
  cv::pyrDown(image, half);
  cv::pyrDown(half, quarter);
  EXPECT_EQ(quarter.size(), cv::Size(level.width, level.height));
  EXPECT_EQ(p.at_level(0).width, 1241);
}

TEST(Pinhole, ContainsCountsPixelCentres) {
  const Pinhole p{500, 500, 5, 4, 10, 8};
  EXPECT_TRUE(p.contains({0, 0}));
  EXPECT_TRUE(p.contains({9, 7}));
  EXPECT_FALSE(p.contains({9.01, 7}));
  EXPECT_FALSE(p.contains({-0.01, 0}));
  EXPECT_FALSE(p.contains({1.9, 4}, 2));
  EXPECT_TRUE(p.contains({2, 5}, 2));
  EXPECT_FALSE(p.contains({std::nan(""), 4}));
}

std::string complaint(const Camera& c) {
  try {
    c.check("cam.txt");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

// The fr1 camera with other numbers.
Camera with(const std::function<void(Pinhole*, Distortion*)>& change) {
  Pinhole p = fr1().pinhole();
  Distortion d = fr1().distortion();
  change(&p, &d);
  return {p, d};
}

TEST(Camera, CheckNamesTheInvalidField) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(complaint(fr1()), "");
  EXPECT_THAT(complaint(with([](Pinhole* p, Distortion*) { p->width = 0; })),
              HasSubstr("cam.txt: image size 0x480 is not positive"));
  EXPECT_THAT(complaint(with([](Pinhole* p, Distortion*) { p->fy = -1; })),
              HasSubstr("focal lengths must be positive"));
  EXPECT_THAT(complaint(with([](Pinhole* p, Distortion*) { p->fx = kInfinite; })),
              HasSubstr("focal lengths must be positive"));
  for (const double focal : {1e30, 1e-30, 0.8})
    EXPECT_THAT(complaint(with([&](Pinhole* p, Distortion*) { p->fx = focal; })),
                HasSubstr("below one pixel or above a million"));
  EXPECT_THAT(complaint(with([](Pinhole* p, Distortion*) { p->cx = 700; })),
              HasSubstr("principal point lies outside"));
  EXPECT_THAT(complaint(with([](Pinhole* p, Distortion*) { p->width = p->height = 1; })),
              HasSubstr("lies outside the image: (318.6, 255.3) in 1x1 pixels; give cx cy in pixels, and the "
                        "size of the images"));
  EXPECT_THAT(complaint(with([](Pinhole* p, Distortion*) { p->cy = std::nan(""); })),
              HasSubstr("principal point lies outside"));
  EXPECT_THAT(complaint(with([](Pinhole*, Distortion* d) { d->k3 = std::nan(""); })),
              HasSubstr("k1 k2 p1 p2 k3 must be numbers"));
}

}  // namespace
}  // namespace edgevo
