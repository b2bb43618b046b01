// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/up_direction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "edgevo/core/camera_mount.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {
namespace {

constexpr double kCameraHeight = 1.65, kDegrees = 180 / 3.14159265358979323846;

struct Street {
  std::string mount = "0,0,0";
  bool has_ground = true, has_poles = true;
  /// Degrees by which the poles lean to the left.
  double lean = 0;
  /// Metres a frame; 0: the camera turns where it stands.
  double step = 0.5;
  /// Largest turn to each side, radians.
  double bend = 0.5;
};

SE3 true_mount(const Street& street) { return T_vehicle_cam(parse_camera_mount(street.mount, "")); }

EdgePoint seen_point(const Pinhole& pinhole, const Eigen::Vector3d& p_cam) {
  EdgePoint p;
  p.px = pinhole.project(p_cam).cast<float>();
  p.normal = {0, 1};
  p.idepth = float(1 / p_cam.z());
  p.idepth_sigma = 0.01f * p.idepth;
  p.observations = 4;
  return p;
}

EdgeLine seen_line(const Pinhole& pinhole, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  EdgeLine line;
  line.is_straight = true;
  for (const Eigen::Vector3d& p : {a, b})
    line.vertices.push_back(
        {pinhole.project(p).cast<float>(), float(1 / p.z()), float(0.002 / p.z()), 0, 255});
  return line;
}

// A vehicle on a winding road between walls and poles, as a camera with that mount sees it. Vehicle axes.
Run drive_through(const Street& street) {
  Run run;
  run.pinhole = {700, 700, 600, 200, 1200, 400};
  const SE3 mount = true_mount(street);
  std::mt19937 random(1);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int i = 0; i < 300; ++i) {
    const Eigen::AngleAxisd heading(street.bend * std::sin(0.02 * i), Eigen::Vector3d::UnitZ());
    KeyframeRecord keyframe;
    keyframe.frame_index = i;
    keyframe.time = Timestamp::from_seconds(0.1 * i);
    keyframe.T_world_cam = mount.inverse() * SE3(Eigen::Quaterniond(heading), position) * mount;
    const auto in_camera = [&](double x, double y, double z) {
      return Eigen::Vector3d(mount.inverse() * Eigen::Vector3d(x, y, z));
    };
    const auto add = [&](const Eigen::Vector3d& p) {
      if (p.z() > 0.5) keyframe.points.push_back(seen_point(run.pinhole, p));
    };
    for (int k = 0; k < 6; ++k) {
      if (street.has_ground) add(in_camera(uniform(4, 10), uniform(-4, 4), -kCameraHeight));
      add(in_camera(uniform(6, 15), uniform(0, 1) < 0.5 ? -6 : 6, uniform(-kCameraHeight, 5)));
    }
    const double x = uniform(6, 15), aside = uniform(0, 1) < 0.5 ? -5 : 5;
    const Eigen::Vector3d foot = in_camera(x, aside, 0),
                          head = in_camera(x, aside + 2 * std::tan(street.lean / kDegrees), 2);
    if (street.has_poles && foot.z() > 0.5 && head.z() > 0.5)
      keyframe.lines.push_back(seen_line(run.pinhole, foot, head));
    run.keyframes.push_back(keyframe);
    position += heading * Eigen::Vector3d(street.step, 0, 0);
  }
  return run;
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return kDegrees * std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Vector3d true_up(const Street& street) {
  return true_mount(street).R().transpose() * Eigen::Vector3d::UnitZ();
}

// Slope of the way in the map, degrees: the road is level.
double slope_of_way(const Run& run) {
  const Eigen::Vector3d way = T_map_world(run).R() * (run.keyframes.back().T_world_cam.translation() -
                                                      run.keyframes.front().T_world_cam.translation());
  return kDegrees * std::atan2(way.z(), way.head<2>().norm());
}

TEST(UpDirection, IsFoundWithinADegreeForEveryMount) {
  for (const char* mount : {"0,0,0", "0,20,0", "0,-20,0", "0,30,0", "90,0,0", "180,0,0", "-90,10,0",
                            "7,-12,0", "0,10,25", "0,0,-30"}) {
    const Street street{mount};
    const auto up = estimate_up(drive_through(street));
    ASSERT_TRUE(up) << mount;
    EXPECT_TRUE(up->is_certain) << mount << " by " << up->seen_in;
    EXPECT_LT(degrees_between(up->up, true_up(street)), 1) << mount;
    EXPECT_LT(degrees_between(up->up, true_up(street)), 3 * up->sigma_deg) << mount;
  }
}

TEST(UpDirection, TheMapOfATiltedOrTurnedCameraIsLevel) {
  for (const char* mount : {"0,20,0", "0,-20,0", "90,0,0", "180,10,0"}) {
    edgevo::Run run = drive_through({mount});
    const auto decision = decide_up(&run);
    ASSERT_TRUE(run.T_vehicle_cam) << mount;
    EXPECT_LT(std::abs(slope_of_way(run)), 1) << mount;
    EXPECT_EQ(decision->doubt, "");
    EXPECT_THAT(decision->reason, ::testing::HasSubstr("ground, vertical lines, turns"));
    const auto height = seen_camera_height(run, ScaleParams());
    ASSERT_TRUE(height) << mount;
    EXPECT_NEAR(*height, kCameraHeight, 0.03) << mount;
  }
}

TEST(UpDirection, AMountThatContradictsWhatWasSeenIsDoubted) {
  edgevo::Run run = drive_through({"0,20,0"});
  run.T_vehicle_cam = T_vehicle_cam(parse_camera_mount("0,20,0", ""));
  EXPECT_FALSE(decide_up(&run));
  run.T_vehicle_cam = T_vehicle_cam(parse_camera_mount("0,-20,0", ""));
  const auto decision = decide_up(&run);
  ASSERT_TRUE(decision);
  EXPECT_THAT(decision->doubt, ::testing::HasSubstr("differs from it by 40 degrees"));
  EXPECT_NEAR(camera_mount(*run.T_vehicle_cam).pitch_deg, -20, 1e-6) << "what the user says counts";
}

TEST(UpDirection, AYawWithWhichTheVehicleDrivesBackwardsIsDoubted) {
  edgevo::Run run = drive_through({"0,20,0"});
  run.T_vehicle_cam = T_vehicle_cam(parse_camera_mount("0,20,180", ""));
  const auto decision = decide_up(&run);
  ASSERT_TRUE(decision);
  EXPECT_THAT(decision->value, ::testing::ContainsRegex("moves 1(79|80) degrees from its forward axis"));
  EXPECT_THAT(decision->doubt, ::testing::HasSubstr("the yaw of the mount"));
}

// Roll and pitch are seen; what is ahead of the vehicle is not.
TEST(UpDirection, TheYawStaysThatOfTheFirstCamera) {
  edgevo::Run run = drive_through({"5,20,15"});
  decide_up(&run);
  ASSERT_TRUE(run.T_vehicle_cam);
  const CameraMount m = camera_mount(*run.T_vehicle_cam);
  EXPECT_NEAR(m.roll_deg, 5, 1);
  EXPECT_NEAR(m.pitch_deg, 20, 1);
  EXPECT_NEAR(m.yaw_deg, 0, 1e-9);
}

TEST(UpDirection, ACameraThatLooksAheadIsLeftAlone) {
  for (const char* mount : {"0,0,0", "1,2,0", "0,0,20"}) {
    edgevo::Run run = drive_through({mount});
    const auto decision = decide_up(&run);
    EXPECT_FALSE(run.T_vehicle_cam) << mount;
    EXPECT_EQ(decision->value, "looks straight ahead");
    EXPECT_EQ(decision->doubt, "") << mount;
  }
}

// As cameras of cars are mounted: their maps stay as they were, and the user is informed.
TEST(UpDirection, ASlightTiltIsADoubtWithTheMountToGive) {
  edgevo::Run run = drive_through({"0,5,0"});
  const auto decision = decide_up(&run);
  EXPECT_FALSE(run.T_vehicle_cam);
  EXPECT_THAT(
      decision->doubt,
      ::testing::ContainsRegex("looks [45]\\.[0-9] degrees down.*give --mount -?0\\.[0-9],[45]\\.[0-9],0"));
}

TEST(UpDirection, AGivenMountIsNotTouched) {
  edgevo::Run run = drive_through({"0,20,0"});
  run.T_vehicle_cam = T_zup_world();
  EXPECT_NE(decide_up(&run)->doubt, "");
  EXPECT_EQ(run.T_vehicle_cam->matrix(), T_zup_world().matrix());
}

TEST(UpDirection, CuesThatContradictAreADoubt) {
  Street street{"0,20,0"};
  street.lean = 15;
  edgevo::Run run = drive_through(street);
  const auto decision = decide_up(&run);
  EXPECT_FALSE(run.T_vehicle_cam);
  EXPECT_THAT(decision->doubt, ::testing::HasSubstr("not certain"));
  EXPECT_THAT(decision->doubt, ::testing::HasSubstr("give --mount roll,pitch,yaw")) << "no figures to copy";
}

// A camera that looks up sees no ground: lines and turns suffice, as long as it is not upside down.
TEST(UpDirection, IsFoundWithoutTheGroundForAnUprightCamera) {
  Street street{"5,-25,0"};
  street.has_ground = false;
  const auto up = estimate_up(drive_through(street));
  ASSERT_TRUE(up);
  EXPECT_TRUE(up->is_certain);
  EXPECT_LT(degrees_between(up->up, true_up(street)), 1);
}

// On a straight road only the lines are left; they are believed where they agree with a right angle.
TEST(UpDirection, IsFoundFromVerticalLinesAlone) {
  Street street{"0,-20,0"};
  street.has_ground = false, street.bend = 0;
  const auto up = estimate_up(drive_through(street));
  ASSERT_TRUE(up);
  EXPECT_TRUE(up->is_certain);
  EXPECT_EQ(up->seen_in, "direction of travel, vertical lines");
  EXPECT_LT(degrees_between(up->up, true_up(street)), 1);
}

TEST(UpDirection, ACameraInPureRotationHasNone) {
  Street street{"0,20,0"};
  street.step = 0;
  edgevo::Run run = drive_through(street);
  const auto decision = decide_up(&run);
  EXPECT_FALSE(run.T_vehicle_cam);
  EXPECT_EQ(decision->reason, "assumed");
}

TEST(UpDirection, AnEmptyRunHasNone) {
  EXPECT_FALSE(estimate_up(edgevo::Run()));
  edgevo::Run run;
  EXPECT_TRUE(decide_up(&run));
}

// The ground that gives the scale is looked for under the vehicle, wherever the camera's own "down" points.
TEST(UpDirection, TheGroundIsFoundBelowATurnedCameraWithAMount) {
  edgevo::Run run = drive_through({"90,10,0"});
  EXPECT_FALSE(seen_camera_height(run, ScaleParams()));
  run.T_vehicle_cam = true_mount({"90,10,0"});
  const auto height = seen_camera_height(run, ScaleParams());
  ASSERT_TRUE(height);
  EXPECT_NEAR(*height, kCameraHeight, 0.03);
}

}  // namespace
}  // namespace edgevo
