// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/servo_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "servo_test_views.h"

namespace edgevo {
namespace {

using test::at;
using test::tracked;

const Pinhole kPinhole{500, 500, 319.5, 239.5, 640, 480};

// Points on a plane at depth 2, every 40 pixels. Every third one has a large depth uncertainty, every fourth
// one has no identity.
std::vector<CloudPoint> grid(double idepth = 0.5) {
  std::vector<CloudPoint> points;
  for (int v = 20; v < 480; v += 40)
    for (int u = 20; u < 640; u += 40) {
      CloudPoint p;
      p.px = {float(u), float(v)};
      p.ray = kPinhole.ray({double(u), double(v)});
      p.normal = {1, 0};
      p.idepth = idepth;
      p.idepth_sigma = points.size() % 3 == 0 ? 0.3 * idepth : 0.01 * idepth;
      if (points.size() % 4 != 0) p.host_keyframe = 7, p.host_pixel = int(points.size());
      points.push_back(p);
    }
  return points;
}

ServoPose pose_at(const SE3& T_cam_map, std::vector<CloudPoint> cloud, int segment = 0,
                  ServoFeed* feed = nullptr) {
  ServoFeed own;
  NewestPose view = tracked(0, 10, T_cam_map, segment);
  view.reference = test::reference_with(std::move(cloud));
  (feed ? *feed : own).publish(view);
  return (feed ? *feed : own).pose(at(10));
}

TEST(ServoPoints, ChoosesPointsOfKnownDepthSpreadOverTheImage) {
  ServoPoints points(kPinhole);
  const ServoPose pose = pose_at({}, grid());
  ASSERT_EQ(points.choose(pose, 12), 12);
  double u_min = 1e9, u_max = 0, v_min = 1e9, v_max = 0;
  for (const ServoPoint& p : points.features(pose)) {
    EXPECT_NE(p.host_pixel % 3, 0) << "its depth is uncertain";
    EXPECT_NE(p.host_pixel % 4, 0) << "it has no identity";
    EXPECT_TRUE(p.in_view);
    const Eigen::Vector2d px = kPinhole.project({p.point.get_x(), p.point.get_y(), 1});
    u_min = std::min(u_min, px.x()), u_max = std::max(u_max, px.x());
    v_min = std::min(v_min, px.y()), v_max = std::max(v_max, px.y());
  }
  EXPECT_GT(u_max - u_min, 500);
  EXPECT_GT(v_max - v_min, 350);
}

TEST(ServoPoints, AreTheSameInTheSameOrderFromAnotherPose) {
  ServoPoints points(kPinhole);
  const ServoPose taught = pose_at({}, grid());
  points.choose(taught, 8);
  const auto before = points.features(taught);
  const SE3 T = SE3::exp(0.3 * test::kMotion);
  const auto after = points.features(pose_at(T, grid()));
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].host_pixel, before[i].host_pixel);
    const vpFeaturePoint& b = before[i].point;
    const Eigen::Vector3d p = T * (b.get_Z() * Eigen::Vector3d(b.get_x(), b.get_y(), 1));
    EXPECT_NEAR(after[i].point.get_x(), p.x() / p.z(), 1e-12);
    EXPECT_NEAR(after[i].point.get_y(), p.y() / p.z(), 1e-12);
    EXPECT_NEAR(after[i].point.get_Z(), p.z(), 1e-12);
    EXPECT_NEAR(after[i].point3d.get_X(), p.x(), 1e-12);
    EXPECT_NEAR(after[i].point3d.get_Z(), p.z(), 1e-12);
  }
}

TEST(ServoPoints, FollowTheMapWhileTheirKeyframeIsActive) {
  ServoPoints points(kPinhole);
  points.choose(pose_at({}, grid()), 8);
  for (const ServoPoint& p : points.features(pose_at({}, grid(0.25))))
    EXPECT_NEAR(p.point.get_Z(), 4, 1e-9);  // the adjustment moved them
  for (const ServoPoint& p : points.features(pose_at({}, {})))
    EXPECT_NEAR(p.point.get_Z(), 4, 1e-9);  // their keyframe was marginalised
}

TEST(ServoPoints, AreEmptyForAnotherMapOrWithoutAUsablePose) {
  ServoFeed feed;
  ServoPoints points(kPinhole);
  points.choose(pose_at({}, grid(), 0, &feed), 8);
  EXPECT_EQ(points.features(feed.pose(at(10))).size(), 8u);
  EXPECT_TRUE(points.features(feed.pose(at(20))).empty()) << "stale";
  EXPECT_TRUE(points.features(pose_at({}, grid(), 1, &feed)).empty()) << "another segment";
  EXPECT_EQ(points.choose(feed.pose(at(20)), 8), 0);
}

// Draws poses and depths from their distributions and compares the spread with the sigmas.
TEST(ServoPoints, SigmasAreThoseOfPoseAndDepth) {
  ServoPoints points(kPinhole);
  std::vector<CloudPoint> cloud = grid();
  for (CloudPoint& p : cloud) p.idepth_sigma = 0.02 * p.idepth;
  const SE3 T = SE3::exp(0.5 * test::kMotion);
  const ServoPose pose = pose_at(T, cloud);
  points.choose(pose, 4);
  for (const ServoPoint& reported : points.features(pose)) {
    const CloudPoint& c = cloud[size_t(reported.host_pixel)];
    const auto feature = [&](const SE3& T_cam_map, double idepth) -> Eigen::Vector3d {
      const Eigen::Vector3d p = T_cam_map * (c.ray / idepth);
      return {p.x() / p.z(), p.y() / p.z(), p.z()};
    };
    const Eigen::Vector3d mean = feature(T, c.idepth);
    Eigen::Vector3d variance = (feature(T, c.idepth + c.idepth_sigma) - mean).array().square();
    for (int i = 0; i < 6; ++i) {
      const Vector6d xi = 1e-3 * Vector6d::Unit(i);  // one sigma of tracked()
      variance += Eigen::Vector3d((feature(SE3::exp(xi) * T, c.idepth) - mean).array().square());
    }
    EXPECT_NEAR(reported.sigma_x, std::sqrt(variance[0]), 0.03 * reported.sigma_x);
    EXPECT_NEAR(reported.sigma_y, std::sqrt(variance[1]), 0.03 * reported.sigma_y);
    EXPECT_NEAR(reported.sigma_Z, std::sqrt(variance[2]), 0.03 * reported.sigma_Z);
  }
}

TEST(ServoPoints, LengthsAreInMetresOnceThereIsAScale) {
  ServoFeed feed;
  feed.set_scale({3, 0, "factor"});
  ServoPoints points(kPinhole);
  const ServoPose pose = pose_at({}, grid(), 0, &feed);
  points.choose(pose, 5);
  for (const ServoPoint& p : points.features(pose)) EXPECT_NEAR(p.point.get_Z(), 6, 1e-9);
}

}  // namespace
}  // namespace edgevo
