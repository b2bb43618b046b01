// SPDX-License-Identifier: BSD-3-Clause
// The convention of a camera's mount, by hand.
#include "edgevo/core/camera_mount.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/records.h"

namespace edgevo {
namespace {

using Eigen::Vector3d;

// Directions in the camera: x right, y down, z forward.
const Vector3d kRight(1, 0, 0), kDown(0, 1, 0), kAhead(0, 0, 1);

// Where a direction of the camera points to on the vehicle: x forward, y left, z up.
Vector3d on_vehicle(const std::string& mount, const Vector3d& in_camera) {
  return T_vehicle_cam(parse_camera_mount(mount, "--mount")).R() * in_camera;
}

std::string error_of(const std::string& mount) {
  try {
    parse_camera_mount(mount, "--mount");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

void expect_near(const Vector3d& a, const Vector3d& b) { EXPECT_LT((a - b).norm(), 1e-12) << a.transpose(); }

TEST(CameraMount, ZeroLooksStraightAheadAndIsLevel) {
  expect_near(on_vehicle("0,0,0", kAhead), {1, 0, 0});
  expect_near(on_vehicle("0,0,0", kRight), {0, -1, 0});
  expect_near(on_vehicle("0,0,0", kDown), {0, 0, -1});
  EXPECT_EQ(T_vehicle_cam(CameraMount()).matrix(), T_zup_world().matrix());
}

TEST(CameraMount, PositivePitchLooksDown) {
  expect_near(on_vehicle("0,30,0", kAhead), {std::sqrt(0.75), 0, -0.5});
  expect_near(on_vehicle("0,30,0", kDown), {-0.5, 0, -std::sqrt(0.75)});
}

TEST(CameraMount, PositiveYawLooksLeft) {
  expect_near(on_vehicle("0,0,90", kAhead), {0, 1, 0});
  expect_near(on_vehicle("0,0,90", kRight), {1, 0, 0});
}

// Clockwise from behind: the right side of the camera points down.
TEST(CameraMount, PositiveRollTurnsClockwise) {
  expect_near(on_vehicle("90,0,0", kRight), {0, 0, -1});
  expect_near(on_vehicle("180,0,0", kDown), {0, 0, 1});
  expect_near(on_vehicle("90,0,0", kAhead), {1, 0, 0});
}

// Roll first, then pitch, then yaw, about the axes of the vehicle: to the left and 30 degrees down, with the
// camera's right side still where the roll put it.
TEST(CameraMount, TheOrderIsRollPitchYaw) {
  expect_near(on_vehicle("90,30,90", kAhead), {0, std::sqrt(0.75), -0.5});
  expect_near(on_vehicle("90,30,90", kRight), {0, -0.5, -std::sqrt(0.75)});
}

TEST(CameraMount, PositionIsThatOfTheCameraOnTheVehicle) {
  const SE3 T = T_vehicle_cam(parse_camera_mount("0, 20, 0, 0.3, -0.1, 1.2", "--mount"));
  expect_near(T * Vector3d(0, 0, 0), {0.3, -0.1, 1.2});
}

TEST(CameraMount, AnglesComeBackFromTheTransform) {
  for (const char* text : {"0,0,0", "10,-20,30", "-170,80,-100", "90,0,0"}) {
    const CameraMount m = parse_camera_mount(text, "");
    const CameraMount back = camera_mount(T_vehicle_cam(m));
    EXPECT_NEAR(back.roll_deg, m.roll_deg, 1e-9);
    EXPECT_NEAR(back.pitch_deg, m.pitch_deg, 1e-9);
    EXPECT_NEAR(back.yaw_deg, m.yaw_deg, 1e-9);
  }
  const SE3 straight_down = T_vehicle_cam(parse_camera_mount("0,90,30", ""));
  EXPECT_LT((T_vehicle_cam(camera_mount(straight_down)).matrix() - straight_down.matrix()).norm(), 1e-6);
}

TEST(CameraMount, NonsenseIsRefusedWithAnExample) {
  for (const char* text : {"", "20", "0,20", "0,20,0,1", "0,20,0,1,2,3,4", "0,twenty,0", "0,nan,0", "0,400,0",
                           "0,0,0,0,0,1650", "0,,0", "0,20,0,"})
    EXPECT_THAT(error_of(text), ::testing::HasSubstr("0,20,0 is a camera 20 degrees down")) << text;
}

TEST(CameraMount, IsSaidInWords) {
  EXPECT_EQ(describe(parse_camera_mount("0,20,0", "")),
            "looks 20.0 degrees down and 0.0 to the left, turned 0.0 clockwise");
  EXPECT_EQ(describe(parse_camera_mount("-90,-5,-10", "")),
            "looks 5.0 degrees up and 10.0 to the right, turned 90.0 counter-clockwise");
}

}  // namespace
}  // namespace edgevo
