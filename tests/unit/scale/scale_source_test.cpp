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
    parse_scale_source(option);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ScaleSource, ReadsEveryKind) {
  EXPECT_EQ(parse_scale_source("none").kind, ScaleSource::Kind::kNone);
  EXPECT_EQ(parse_scale_source("factor=2.5").value, 2.5);
  EXPECT_EQ(parse_scale_source("camera_height=1.65").value, 1.65);
  EXPECT_EQ(*parse_scale_source("odometry").sensor(), VehicleSensor::kOdometry);
  EXPECT_EQ(*parse_scale_source("gps").sensor(), VehicleSensor::kGps);
  EXPECT_EQ(*parse_scale_source("robot_pose").sensor(), VehicleSensor::kRobotPose);
  EXPECT_EQ(parse_scale_source("camera_height=1.65").text, "camera_height=1.65");
}

TEST(ScaleSource, OnlyMeasuredOnesAreEstimated) {
  for (const char* measured : {"odometry", "gps", "robot_pose", "camera_height=1"})
    EXPECT_TRUE(parse_scale_source(measured).is_estimated()) << measured;
  for (const char* given : {"none", "factor=2"})
    EXPECT_FALSE(parse_scale_source(given).is_estimated()) << given;
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
