// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "drive_over_ground.h"
#include "edgevo/scale/run_scale.h"

namespace edgevo {
namespace {

using test::drive_over_ground;
using test::GroundDrive;
using test::MadeRun;

const ScaleSource kOdometry{ScaleSource::Kind::kOdometry, 0, "odometry"};

VehicleTracks of_wheels(const VehicleTrack& track) { return {{VehicleSensor::kOdometry, track}}; }

struct TrackNoise {
  /// Noise of each step of an odometer, relative.
  double step = 0;
  /// Noise of each position of a GPS, metres.
  double position = 0;
  int every = 1;
};

// Track in the sensor's own frame, which is rotated and translated against the camera's.
VehicleTrack track_of(const MadeRun& made, const TrackNoise& noise,
                      const Eigen::Vector3d& sensor_in_camera = Eigen::Vector3d::Zero()) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const SE3 T_sensor_world(Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized())),
                           {100, -50, 3});
  VehicleTrack track;
  Eigen::Vector3d position = T_sensor_world * (made.truth[0] * sensor_in_camera), last = position;
  for (size_t i = 0; i < made.truth.size(); i += size_t(noise.every)) {
    const Eigen::Vector3d here = T_sensor_world * (made.truth[i] * sensor_in_camera);
    position += (1 + noise.step * normal(random)) * (here - last);
    last = here;
    const Eigen::Vector3d jitter(normal(random), normal(random), normal(random));
    track.positions.push_back({made.run.frames[i].time, position + noise.position * jitter});
  }
  return track;
}

MadeRun in_metres(const GroundDrive& drive, const TrackNoise& noise) {
  MadeRun made = drive_over_ground(drive);
  const RunScale scale =
      estimate_run_scale(made.run, kOdometry, of_wheels(track_of(made, noise)), ScaleParams());
  EXPECT_EQ(scale.problem, "");
  if (scale.problem.empty()) make_metric(scale, {}, kOdometry, &made.run);
  return made;
}

TEST(TrackScale, ExactTrackGivesTheExactScale) {
  const MadeRun made = in_metres({}, {});
  EXPECT_NEAR(made.run.scale.factor, 2, 1e-6);
  EXPECT_LT(test::largest_error(made.run, made.truth), 1e-3);
}

TEST(TrackScale, StepsWithTwoPercentOfNoise) {
  const MadeRun made = in_metres({}, {0.02, 0, 1});
  EXPECT_NEAR(test::length_of(made.run), 149.5, 0.01 * 149.5);
  EXPECT_LT(std::abs(made.run.scale.factor / 2 - 1), 3 * made.run.scale.sigma + 1e-3);
}

TEST(TrackScale, GpsOfOneMetreAndADrift) {
  GroundDrive drive;
  drive.metres_per_unit_begin = 1.9, drive.metres_per_unit_end = 2.1;
  const MadeRun made = in_metres(drive, {0, 1.0, 2});
  EXPECT_NEAR(test::length_of(made.run), 149.5, 0.02 * 149.5);
  EXPECT_GT(made.run.scale.sigma, 0.001);
}

TEST(TrackScale, FixesThatJumpAreRejected) {
  MadeRun made = drive_over_ground({});
  VehicleTrack track = track_of(made, {0, 0.05, 1});
  for (size_t i = 20; i < track.positions.size(); i += 25)
    track.positions[i].position += Eigen::Vector3d(30, -20, 10);
  const RunScale scale = estimate_run_scale(made.run, kOdometry, of_wheels(track), ScaleParams());
  ASSERT_FALSE(scale.of_frame.empty());
  EXPECT_NEAR(scale.of_frame[150].factor, 2, 0.01);
}

// An antenna a metre and a half to the side of the camera follows a different path through a bend.
TEST(TrackScale, LeverArmOfTheSensorIsCompensated) {
  MadeRun made = drive_over_ground({});
  // The vehicle's axes are the camera's here.
  made.run.T_vehicle_cam = SE3(Eigen::Quaterniond::Identity(), {0.2, 0, 0});
  VehicleTrack track = track_of(made, {}, {1.5, 0, 0});
  track.sensor_on_vehicle = {1.7, 0, 0};
  const RunScale right = estimate_run_scale(made.run, kOdometry, of_wheels(track), ScaleParams());
  EXPECT_NEAR(right.of_frame[150].factor, 2, 0.002);
  made.run.T_vehicle_cam.reset();
  const RunScale wrong = estimate_run_scale(made.run, kOdometry, of_wheels(track), ScaleParams());
  EXPECT_GT(std::abs(wrong.of_frame[150].factor - 2), std::abs(right.of_frame[150].factor - 2));
}

TEST(TrackScale, TracksOfOtherTimesOrWithoutMotionGiveNoScale) {
  const MadeRun made = drive_over_ground({});
  VehicleTrack late = track_of(made, {});
  for (VehiclePosition& p : late.positions) p.time.ticks += 1000 * Timestamp::kTicksPerSecond;
  EXPECT_FALSE(estimate_run_scale(made.run, kOdometry, of_wheels(late), ScaleParams()).problem.empty());
  VehicleTrack still = track_of(made, {});
  for (VehiclePosition& p : still.positions) p.position.setZero();
  EXPECT_FALSE(estimate_run_scale(made.run, kOdometry, of_wheels(still), ScaleParams()).problem.empty());
  EXPECT_FALSE(estimate_run_scale(made.run, kOdometry, {}, ScaleParams()).problem.empty());
}

TEST(TrackScale, LiveScaleFollowsATrack) {
  const MadeRun made = drive_over_ground({});
  LiveScale live(made.run.pinhole, kOdometry, of_wheels(track_of(made, {0.02, 0, 1})), std::nullopt,
                 ScaleParams());
  for (const FrameRecord& f : made.run.frames) live.add_frame(f);
  ASSERT_TRUE(live.newest());
  EXPECT_NEAR(live.newest()->factor, 2, 0.04);
}

TEST(EffectiveCount, OfIndependentAndOfEqualNeighbours) {
  EXPECT_DOUBLE_EQ(effective_count({1, -1, 1, -1}), 4);
  EXPECT_LT(effective_count(std::vector<double>(100, 1.0)), 2);
  EXPECT_EQ(effective_count({}), 1);
}

}  // namespace
}  // namespace edgevo
