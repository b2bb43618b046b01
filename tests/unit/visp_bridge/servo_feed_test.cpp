// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/servo_feed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/error.h"
#include "edgevo/visp_bridge/conversions.h"
#include "servo_test_views.h"

namespace edgevo {
namespace {

using test::at;
using test::lost;
using test::tracked;
using ::testing::HasSubstr;

double distance(const vpHomogeneousMatrix& M, const SE3& T) {
  return (to_se3(M).matrix() - T.matrix()).norm();
}

TEST(ServoFeed, IsNotUsableBeforeAnImage) {
  const ServoPose pose = ServoFeed().pose(at(1));
  EXPECT_FALSE(pose.usable);
  EXPECT_THAT(pose.reason, HasSubstr("no image"));
}

TEST(ServoFeed, GivesTheNewestPoseWithItsAge) {
  ServoFeed feed;
  const SE3 T = SE3::exp(test::kMotion);
  feed.publish(tracked(0, 10, T));
  const ServoPose pose = feed.pose(at(10.05));
  EXPECT_TRUE(pose.usable) << pose.reason;
  EXPECT_EQ(pose.state, TrackingState::kTracking);
  EXPECT_NEAR(pose.age_s, 0.05, 1e-6);
  EXPECT_EQ(pose.predicted_s, 0) << "one pose gives no velocity";
  EXPECT_LT(distance(pose.cMw, T), 1e-12);
}

TEST(ServoFeed, PredictsAtConstantVelocity) {
  ServoFeed feed;
  feed.publish(tracked(0, 10.0, SE3()));
  feed.publish(tracked(1, 10.1, SE3::exp(0.1 * test::kMotion)));
  const ServoPose pose = feed.pose(at(10.17));
  EXPECT_LT(distance(pose.cMw, SE3::exp(0.17 * test::kMotion)), 1e-9);
  EXPECT_LT(distance(pose.cMw_at_image, SE3::exp(0.1 * test::kMotion)), 1e-12);
  EXPECT_NEAR(pose.predicted_s, 0.07, 1e-6);
  EXPECT_GT(pose.covariance[0][0], feed.pose(at(10.1)).covariance[0][0]) << "a prediction is less certain";
}

TEST(ServoFeed, DoesNotPredictForLong) {
  ServoFeedOptions options;
  options.stale_after_s = 5;
  options.max_prediction_s = 0.2;
  ServoFeed feed(options);
  feed.publish(tracked(0, 10.0, SE3()));
  feed.publish(tracked(1, 10.1, SE3::exp(0.1 * test::kMotion)));
  EXPECT_LT(distance(feed.pose(at(12)).cMw, SE3::exp(0.3 * test::kMotion)), 1e-9);
}

TEST(ServoFeed, StaleAndLostAreNotUsable) {
  ServoFeed feed;
  feed.publish(tracked(0, 10, SE3()));
  EXPECT_TRUE(feed.pose(at(10.29)).usable);
  EXPECT_THAT(feed.pose(at(10.31)).reason, HasSubstr("stale"));
  EXPECT_FALSE(feed.pose(at(10.31)).usable);
  feed.publish(lost(1, 10.4, "too dark"));
  const ServoPose pose = feed.pose(at(10.41));
  EXPECT_FALSE(pose.usable);
  EXPECT_EQ(pose.reason, "LOST: too dark");
}

TEST(ServoFeed, ADoubtfulPoseIsNotUsableIfTheLoopWantsConfidence) {
  ServoFeedOptions cautious;
  cautious.min_p_right = kDoubtfulBelow;
  ServoFeed feed(cautious), plain;
  NewestPose view = tracked(0, 10, SE3());
  feed.publish(view);
  EXPECT_TRUE(feed.pose(at(10)).usable) << "unknown";
  view.p_right = 0.05, view.note = "corners contradict the scale";
  feed.publish(view), plain.publish(view);
  EXPECT_EQ(feed.pose(at(10)).reason, "doubtful, p_right 0.05: corners contradict the scale");
  EXPECT_TRUE(plain.pose(at(10)).usable);
  EXPECT_EQ(plain.pose(at(10)).p_right, 0.05);
}

TEST(ServoFeed, ResumesInTheSameMapWithoutTheOldVelocity) {
  ServoFeed feed;
  feed.publish(tracked(0, 10, SE3()));
  const int version = feed.pose(at(10)).map_version;
  feed.publish(lost(1, 10.1, "dark"));
  feed.publish(tracked(2, 10.2, SE3::exp(test::kMotion)));
  const ServoPose pose = feed.pose(at(10.25));
  EXPECT_TRUE(pose.usable);
  EXPECT_EQ(pose.predicted_s, 0);
  EXPECT_EQ(pose.map_version, version);
}

TEST(ServoFeed, AnotherMapHasAnotherVersion) {
  ServoFeed feed;
  feed.publish(tracked(0, 10, SE3()));
  const int version = feed.pose(at(10)).map_version;
  feed.publish(lost(1, 10.1, "dark"));
  feed.publish(tracked(2, 10.2, SE3(), 1));
  EXPECT_NE(feed.pose(at(10.2)).map_version, version);
  const int second = feed.pose(at(10.2)).map_version;
  feed.publish(tracked(3, 10.3, SE3(), 1, 0.01));  // the lens was corrected
  EXPECT_NE(feed.pose(at(10.3)).map_version, second);
  EXPECT_EQ(feed.pose(at(10.3)).predicted_s, 0);
}

TEST(ServoFeed, TheScaleGivesMetres) {
  ServoFeed feed;
  feed.publish(tracked(0, 10, SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(1, 2, 3))));
  EXPECT_FALSE(feed.pose(at(10)).scale.is_metric());
  const double sigma_units = std::sqrt(feed.pose(at(10)).covariance[2][2]),
               radians = std::sqrt(feed.pose(at(10)).covariance[4][4]);
  feed.set_scale({0.5, 0.02, "taught distance"});
  const ServoPose pose = feed.pose(at(10));
  EXPECT_TRUE(pose.scale.is_metric());
  EXPECT_EQ(pose.scale.relative_sigma, 0.02);
  EXPECT_NEAR(pose.cMw[2][3], 1.5, 1e-12);
  EXPECT_NEAR(std::sqrt(pose.covariance[2][2]), 0.5 * sigma_units, 1e-12);
  EXPECT_NEAR(std::sqrt(pose.covariance[4][4]), radians, 1e-12);
  EXPECT_THROW(feed.set_scale({0, 0, "nonsense"}), InputError);
}

// A second map with another unit and origin, as the odometry joins it to the first.
NewestPose in_second_map(const SE3& T_odom_cam) {
  const Sim3 T_odom_map{2, SE3::exp(test::kMotion)};
  NewestPose view = tracked(3, 10.3, T_odom_map.inverse().apply(T_odom_cam).inverse(), 1);
  view.T_odom_map = T_odom_map.rigid, view.odom_scale = T_odom_map.scale;
  return view;
}

TEST(ServoFeed, OdomGoesOnOverMapsAndScales) {
  ServoFeed feed;
  const SE3 T_cam_odom = SE3::exp(2 * test::kMotion);
  feed.publish(tracked(0, 10, T_cam_odom));
  EXPECT_LT(distance(feed.pose(at(10)).cMo, T_cam_odom), 1e-12);
  EXPECT_LT(distance(feed.pose(at(10)).mMo, SE3()), 1e-12);
  feed.set_scale({0.5, 0.02, "taught distance"});
  const SE3 metric(T_cam_odom.rotation(), 0.5 * T_cam_odom.translation());
  EXPECT_LT(distance(feed.pose(at(10)).cMo, metric), 1e-12);
  feed.publish(in_second_map(T_cam_odom.inverse()));
  EXPECT_LT(distance(feed.pose(at(10.3)).cMo, metric), 1e-9) << "the same place in another map";
  EXPECT_NEAR(feed.pose(at(10.3)).scale.metres_per_unit, 1, 1e-12) << "its unit is twice as long";
  feed.set_scale({1.1, 0.02, "taught distance"});
  EXPECT_LT(distance(feed.pose(at(10.3)).cMo, metric), 1e-9) << "the newest pose stays";
}

TEST(ServoFeed, WhatIsFoundAboutThePastChangesMapAlone) {
  ServoFeed feed;
  feed.set_scale({0.5, 0, "given"});
  NewestPose view = tracked(0, 10, SE3::exp(test::kMotion));
  feed.publish(view);
  const ServoPose before = feed.pose(at(10));
  view.T_world_odom = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(4, 0, 0)), view.world_changes = 1;
  feed.publish(view);
  const ServoPose after = feed.pose(at(10));
  EXPECT_LT(distance(after.cMo, to_se3(before.cMo)), 1e-12);
  EXPECT_LT(distance(after.cMw, to_se3(before.cMw)), 1e-12);
  EXPECT_NEAR(after.mMo[0][3], 2, 1e-12);
  EXPECT_EQ(before.map_changes, 0);
  EXPECT_EQ(after.map_changes, 1);
  EXPECT_EQ(after.map_version, before.map_version);
}

TEST(ServoFeed, AnotherClockIsReported) {
  ServoFeed feed;
  feed.publish(tracked(0, 1000, SE3()));
  EXPECT_THAT(feed.pose(at(10)).reason, HasSubstr("one clock"));
}

TEST(ServoFeed, AFailureIsFinal) {
  ServoFeed feed;
  feed.publish(tracked(0, 10, SE3()));
  feed.fail("image: is 3x3 but the camera is 640x480");
  EXPECT_FALSE(feed.pose(at(10)).usable);
  EXPECT_THAT(feed.pose(at(10)).reason, HasSubstr("3x3"));
}

}  // namespace
}  // namespace edgevo
