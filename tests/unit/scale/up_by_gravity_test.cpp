// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/up_by_gravity.h"

#include <gmock/gmock.h>

#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/random.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/simulation/simulated_gyro.h"

namespace edgevo {
namespace {

constexpr double kUnit = 0.3;  // of the map, metres
constexpr int kFramesASecond = 20;

// A camera that looks ahead, tilted by some degrees, in the hand of somebody who walks and looks about.
SE3 walk(double t) {
  Eigen::Matrix3d R_scene_cam;  // x right, y down, z ahead
  R_scene_cam << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Vector3d at(1.1 * t, 0.4 * std::sin(0.9 * t), 1.5 + 0.03 * std::sin(12 * t));
  const Eigen::Vector3d look(0.2 + 0.15 * std::sin(1.3 * t), 0.5 * std::sin(0.7 * t),
                             0.1 * std::sin(1.9 * t));
  return {Eigen::Quaterniond(R_scene_cam) * rotation_of(look), at};
}

// Without turns: the bias stays with the direction.
SE3 straight_walk(double t) { return {walk(0).rotation(), walk(t).translation()}; }

edgevo::Run run_of(SE3 (*path)(double), double seconds) {
  edgevo::Run run;
  const SE3 T_first_scene = path(0).inverse();
  Random random(4);
  for (int k = 0; k <= kFramesASecond * seconds; ++k) {
    const double t = double(k) / kFramesASecond;
    const SE3 T = T_first_scene * path(t);
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    FrameRecord frame;
    frame.index = k, frame.time = Timestamp::from_seconds(t), frame.segment = 0;
    frame.T_world_cam = SE3(T.rotation() * rotation_of(2e-3 * noise), T.translation() / kUnit + 0.01 * noise);
    run.frames.push_back(frame);
  }
  return run;
}

double error_deg(const UpEstimate& up, SE3 (*path)(double)) {
  const Eigen::Vector3d truth = path(0).rotation().conjugate() * Eigen::Vector3d::UnitZ();
  return deg(std::atan2(truth.cross(up.up).norm(), truth.dot(up.up)));
}

// The truth, known as well as a run knows it.
GyroModel found(const SimulatedGyro& gyro) {
  GyroModel model = gyro.truth;
  model.covariance = 1e-6 * GyroCovariance::Identity();
  return model;
}

TEST(UpByGravity, IsWithinADegreeOfACameraThatIsCarried) {
  for (const char* kind : {"phone", "drone", "robot"})
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      const SimulatedGyro gyro = simulate_gyro(walk, 0, 21, kind, seed);
      const auto up = up_by_gravity(run_of(walk, 20), gyro.samples, found(gyro));
      ASSERT_TRUE(up) << kind;
      EXPECT_LT(error_deg(*up, walk), 1) << kind << seed;
      EXPECT_LT(error_deg(*up, walk), 3 * up->sigma_deg) << kind << seed;
    }
}

TEST(UpByGravity, SaysThatABiasMayTurnItWhereTheCameraDoesNotTurn) {
  const SimulatedGyro gyro = simulate_gyro(straight_walk, 0, 21, "phone", 1);
  const auto up = up_by_gravity(run_of(straight_walk, 20), gyro.samples, found(gyro));
  ASSERT_TRUE(up);
  EXPECT_GT(up->sigma_deg, 0.8);
  EXPECT_FALSE(up->is_certain);
}

TEST(UpByGravity, IsNotKnownOfAFewSecondsOrWithoutAnAccelerometer) {
  SimulatedGyro gyro = simulate_gyro(walk, 0, 21, "phone", 1);
  EXPECT_FALSE(up_by_gravity(run_of(walk, 4), gyro.samples, found(gyro)));
  for (GyroSample& s : gyro.samples) s.acceleration.setZero();
  EXPECT_FALSE(up_by_gravity(run_of(walk, 20), gyro.samples, found(gyro)));
  EXPECT_FALSE(up_by_gravity(run_of(walk, 20), {}, found(gyro)));
}

TEST(UpByGravity, LevelsTheMapOfARunWithoutAMount) {
  const SimulatedGyro gyro = simulate_gyro(walk, 0, 21, "phone", 2);
  edgevo::Run run = run_of(walk, 20);
  const auto decision = decide_up(&run, up_by_gravity(run, gyro.samples, found(gyro)));
  ASSERT_TRUE(decision && run.T_vehicle_cam);
  EXPECT_THAT(decision->reason, ::testing::HasSubstr("accelerometer"));
  const Eigen::Vector3d truth = walk(0).rotation().conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_LT(deg(std::acos((run.T_vehicle_cam->R() * truth).z())), 1);
}

}  // namespace
}  // namespace edgevo
