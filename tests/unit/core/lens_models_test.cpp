// SPDX-License-Identifier: BSD-3-Clause
// The lens models against OpenCV, which has three of them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <opencv2/calib3d.hpp>
#include <opencv2/ccalib/omnidir.hpp>
#include <vector>

#include "edgevo/core/camera.h"

namespace edgevo {
namespace {

const cv::Matx33d kMatrix(231.5, 0, 321.3, 0, 229.7, 238.6, 0, 0, 1);

// A camera of `model` with the focal lengths and principal point of kMatrix, the former times `factor`.
template <class Model>
Camera camera_of(Model model, double factor = 1) {
  Camera camera;
  camera.model = model;
  camera.set_pinhole(
      {factor * kMatrix(0, 0), factor * kMatrix(1, 1), kMatrix(0, 2), kMatrix(1, 2), 640, 480});
  return camera;
}

std::vector<cv::Point3d> points_up_to(double angle) {
  std::vector<cv::Point3d> points;
  for (double a = 0.01; a < angle; a += 0.03)
    for (double azimuth = 0; azimuth < 6.2; azimuth += 0.4)
      points.emplace_back(3 * std::sin(a) * std::cos(azimuth), 3 * std::sin(a) * std::sin(azimuth),
                          3 * std::cos(a));
  return points;
}

using Project = std::function<void(const std::vector<cv::Point3d>&, std::vector<cv::Point2d>*)>;

void expect_as_opencv(const Camera& camera, double up_to, const Project& project) {
  const std::vector<cv::Point3d> points = points_up_to(up_to);
  std::vector<cv::Point2d> expected;
  project(points, &expected);
  ASSERT_EQ(expected.size(), points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const auto px = camera.project({points[i].x, points[i].y, points[i].z});
    ASSERT_TRUE(px) << points[i];
    EXPECT_NEAR(px->x(), expected[i].x, 1e-9) << points[i];
    EXPECT_NEAR(px->y(), expected[i].y, 1e-9) << points[i];
  }
}

const cv::Vec3d kNone(0, 0, 0);

TEST(LensModels, KannalaBrandtIsOpenCvsFisheye) {
  const cv::Vec4d k(3.4e-3, 7.6e-4, -9.9e-4, 2.1e-4);
  // OpenCV's divides by z, and so knows rays in front of the camera only.
  expect_as_opencv(
      camera_of(KannalaBrandtModel{{}, k[0], k[1], k[2], k[3]}), 1.55,
      [&](auto& points, auto* px) { cv::fisheye::projectPoints(points, *px, kNone, kNone, kMatrix, k); });
}

TEST(LensModels, RationalIsOpenCvsWithTwelveCoefficients) {
  const std::vector<double> k{3.1, 1.4, 2e-4, -1e-4, 0.05, 3.4, 2.2, 0.26, 1e-3, -2e-3, 5e-4, 1e-4};
  const RationalDistortion d{{k[0], k[1], k[2], k[3], k[4]}, k[5], k[6], k[7], k[8], k[9], k[10], k[11]};
  expect_as_opencv(camera_of(RationalModel{{}, d}), 1.2,
                   [&](auto& points, auto* px) { cv::projectPoints(points, kNone, kNone, kMatrix, k, *px); });
}

TEST(LensModels, PlumbBobIsOpenCvs) {
  const std::vector<double> k{0.262383, -0.953104, -0.005358, 0.002628, 1.163314};
  const Camera camera = camera_of(PlumbBobModel{{}, {k[0], k[1], k[2], k[3], k[4]}});
  expect_as_opencv(camera, 0.8,
                   [&](auto& points, auto* px) { cv::projectPoints(points, kNone, kNone, kMatrix, k, *px); });
}

TEST(LensModels, OmniIsOpenCvsOmnidir) {
  const cv::Vec4d k(-0.1, 0.2, 1e-3, -5e-4);
  const double xi = 1.6;
  const Camera camera = camera_of(OmniModel{{}, xi, {k[0], k[1], k[2], k[3], 0}}, 1 / (1 + xi));
  expect_as_opencv(camera, camera.max_angle(), [&](auto& points, auto* px) {
    cv::omnidir::projectPoints(points, *px, kNone, kNone, kMatrix, xi, k);
  });
}

}  // namespace
}  // namespace edgevo
