// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/scale_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

std::string complaint(const std::string& option) {
  try {
    parse_scale_sources(option);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

ScaleSource one(const std::string& option) { return parse_scale_sources(option).list.front(); }

TEST(ScaleSource, ReadsEveryKind) {
  EXPECT_EQ(one("none").kind, ScaleSource::Kind::kNone);
  EXPECT_EQ(one("factor=2.5").value, 2.5);
  EXPECT_EQ(one("camera_height=1.65").value, 1.65);
  EXPECT_EQ(*one("odometry").sensor(), VehicleSensor::kOdometry);
  EXPECT_EQ(*one("gps").sensor(), VehicleSensor::kGps);
  EXPECT_EQ(*one("robot_pose").sensor(), VehicleSensor::kRobotPose);
  EXPECT_EQ(one("camera_height=1.65").text, "camera_height=1.65");
}

TEST(ScaleSource, OnlyMeasuredOnesAreEstimated) {
  for (const char* measured : {"odometry", "gps", "robot_pose", "camera_height=1"})
    EXPECT_TRUE(parse_scale_sources(measured).is_estimated()) << measured;
  for (const char* given : {"none", "factor=2"})
    EXPECT_FALSE(parse_scale_sources(given).is_estimated()) << given;
}

TEST(ScaleSource, ReadsAList) {
  const ScaleSources sources = parse_scale_sources("camera_height=1.65,odometry,gps");
  ASSERT_EQ(sources.list.size(), 3u);
  EXPECT_EQ(sources.list[0].text, "camera_height=1.65");
  EXPECT_EQ(sources.list[1].kind, ScaleSource::Kind::kOdometry);
  EXPECT_EQ(sources.list[2].kind, ScaleSource::Kind::kGps);
  EXPECT_EQ(sources.text, "camera_height=1.65,odometry,gps");
  EXPECT_EQ(sources.camera_height(), 1.65);
  EXPECT_FALSE(parse_scale_sources("gps").camera_height());
}

TEST(ScaleSource, RefusesListsThatMakeNoSense) {
  EXPECT_THAT(complaint("gps,factor=2"), HasSubstr("factor=2 goes with no other source"));
  EXPECT_THAT(complaint("none,gps"), HasSubstr("none goes with no other source"));
  EXPECT_THAT(complaint("gps,odometry,gps"), HasSubstr("names a source twice: gps"));
  EXPECT_THAT(complaint("camera_height=1,camera_height=2"), HasSubstr("twice: camera_height=2"));
  for (const char* bad : {",", "gps,", ",gps", "gps,,odometry", "gps odometry", "gps;odometry"})
    EXPECT_THAT(complaint(bad), HasSubstr("; ")) << bad;
}

TEST(ScaleSource, RefusesInvalidOptionsAndSaysWhatToGive) {
  EXPECT_THAT(complaint("odometer"), HasSubstr("did you mean odometry?"));
  EXPECT_THAT(complaint("camera_height"), HasSubstr("camera_height=1.65"));
  EXPECT_THAT(complaint("gps=3"), HasSubstr("takes no value"));
  for (const char* bad :
       {"", "factor", "factor=", "factor=-1", "factor=0", "factor=2x", "factor=inf", "factor=nan",
        "factor=1e300", "factor=1e-300", "camera_height=-1.65", "camera_height=1,65", "camera_height=1e30"})
    EXPECT_THAT(complaint(bad), HasSubstr("; ")) << bad;
}

}  // namespace
}  // namespace edgevo
