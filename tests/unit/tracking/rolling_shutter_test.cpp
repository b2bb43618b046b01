// SPDX-License-Identifier: BSD-3-Clause
// What the odometry expects of a rolling shutter.
#include "edgevo/tracking/rolling_shutter.h"

#include <gtest/gtest.h>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

const Pinhole kCamera{520, 515, 320, 240, 640, 480};

// Points all over the image, near ones in the lower half.
ReferenceCloud cloud_of(int points) {
  ReferenceCloud cloud;
  Random random(3);
  for (int i = 0; i < points; ++i) {
    CloudPoint p;
    p.px = Eigen::Vector2f(float(random.uniform(5, 635)), float(random.uniform(5, 475)));
    p.normal = Eigen::Vector2f::UnitX();
    p.ray = kCamera.ray(p.px.cast<double>());
    p.idepth = p.px.y() < 240 ? 0.2 : 1.0;
    p.host_keyframe = 0;
    cloud.points.push_back(p);
  }
  return cloud;
}

Vector6d twist() {
  Vector6d t;
  t << 0.2, -0.3, 0.1, 0.2, 0.1, -0.2;
  return t;
}

TEST(RollingShutter, DepthsAreThoseOfThePointsInView) {
  const ImageMotion m = image_motion(kCamera, cloud_of(1500), SE3(), twist(), 7);
  EXPECT_EQ(m.velocity, twist());
  EXPECT_NEAR(m.idepth.topRows<2>().mean(), 0.2, 0.05);
  EXPECT_NEAR(m.idepth.bottomRows<2>().mean(), 1.0, 0.05);
}

TEST(RollingShutter, DepthsMoveWithTheCamera) {
  // Halfway towards the points of the lower half: depth 1 becomes 1/2.
  const SE3 forward(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -0.5));
  EXPECT_NEAR(image_motion(kCamera, cloud_of(6000), forward, twist(), 7).idepth.bottomRows<2>().mean(), 2.0,
              0.15);
}

TEST(RollingShutter, WithoutPointsTheMapsMedianIsUsed) {
  EXPECT_NEAR(image_motion(kCamera, ReferenceCloud(), SE3(), twist(), 0.4).idepth.minCoeff(), 0.4, 1e-12);
  ReferenceCloud guessed = cloud_of(500);
  for (CloudPoint& p : guessed.points) p.host_keyframe = -1;
  EXPECT_NEAR(image_motion(kCamera, guessed, SE3(), twist(), 0.4).idepth.maxCoeff(), 0.4, 1e-12);
}

TEST(RollingShutter, ShiftedPointsProjectWhereTheirRowsShowThem) {
  const ReferenceCloud cloud = cloud_of(400);
  Vector6d xi;
  xi << 0.05, -0.02, 0.04, 0.02, -0.03, 0.01;
  const SE3 T_cur_ref = SE3::exp(xi);
  const double readout_s = 0.03;
  const ImageMotion expected = image_motion(kCamera, cloud, T_cur_ref, 0.5 * twist(), 1);
  const ImageMotion found{twist(), expected.idepth};
  const ReferenceCloud shifted = shift_cloud(kCamera, cloud, T_cur_ref, readout_s, expected, found);
  ASSERT_EQ(shifted.points.size(), cloud.points.size());
  double largest = 0;
  for (size_t i = 0; i < cloud.points.size(); ++i) {
    const auto seen = [&](const CloudPoint& p) {
      const Eigen::Vector3d Y = T_cur_ref.R() * p.ray + p.idepth * T_cur_ref.translation();
      return Eigen::Vector2d(Y.head<2>() / Y.z());
    };
    const Eigen::Vector2d x = seen(cloud.points[i]);
    if (!kCamera.contains(kCamera.project(Eigen::Vector3d(x.x(), x.y(), 1)))) continue;
    // The image was rectified for the expected motion: only the remaining shift is visible.
    const Eigen::Vector2d left =
        add_rolling(kCamera, readout_s, found, x) - add_rolling(kCamera, readout_s, expected, x);
    EXPECT_LT((seen(shifted.points[i]) - (x + left)).norm(), 1e-12);
    EXPECT_NEAR(shifted.points[i].ray.z(), 1, 1e-12);
    largest = std::max(largest, 500 * left.norm());
  }
  EXPECT_GT(largest, 1) << "pixels: there was something to shift";
}

// The same point in an image rectified for one motion, and in one rectified for another.
TEST(RollingShutter, AShiftedRayMatchesTheOtherImage) {
  const ImageMotion expected = image_motion(kCamera, cloud_of(400), SE3(), 2 * twist(), 1);
  const ImageMotion measured{4 * twist(), expected.idepth};
  const double readout_s = 0.03;
  for (const Eigen::Vector2d& px :
       {Eigen::Vector2d(100, 60), Eigen::Vector2d(320, 400), Eigen::Vector2d(550, 200)}) {
    const Eigen::Vector2d true_x = kCamera.ray(px).head<2>(),
                          camera_x = add_rolling(kCamera, readout_s, measured, true_x);
    const ImageCorrection correction{0, readout_s};
    const Eigen::Vector2d in_expected = from_file(kCamera, correction, expected, camera_x);
    const Eigen::Vector3d shifted =
        shift_ray(kCamera, readout_s, expected, measured, {in_expected.x(), in_expected.y(), 1});
    const double before = kCamera.fx * (in_expected - true_x).norm(),
                 after = kCamera.fx * (shifted.head<2>() - true_x).norm();
    EXPECT_GT(before, 1) << "pixels";
    EXPECT_LT(after, 0.1 * before);  // to first order
    EXPECT_EQ(shifted.z(), 1);
  }
}

TEST(RollingShutter, NothingShiftsIfTheMotionWasAsExpected) {
  const ReferenceCloud cloud = cloud_of(100);
  const ImageMotion m = image_motion(kCamera, cloud, SE3(), twist(), 1);
  const ReferenceCloud shifted = shift_cloud(kCamera, cloud, SE3(), 0.03, m, m);
  for (size_t i = 0; i < cloud.points.size(); ++i)
    EXPECT_LT((shifted.points[i].ray - cloud.points[i].ray).norm(), 1e-14);
}

}  // namespace
}  // namespace edgevo
