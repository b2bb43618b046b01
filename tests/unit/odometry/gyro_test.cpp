// SPDX-License-Identifier: BSD-3-Clause
// A gyro next to the camera in whole runs: found, used, kept through a blackout, and refused where it is
// wrong.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "edgevo/core/angle.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/simulation/simulated_gyro.h"
#include "unit/odometry/hand_source.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo::test {
namespace {

using ::testing::HasSubstr;

constexpr double kStep = 0.05;  // seconds from image to image
constexpr int kFrames = 110;

// A hand that moves through the room and looks about.
SE3 slow_hand_at(double t) {
  const Eigen::Vector3d turn(0.06 * std::sin(2.3 * t), 0.10 * std::sin(1.7 * t), 0.05 * std::sin(1.9 * t));
  return sweep_pose(t / kStep) * SE3(rotation_of(turn), Eigen::Vector3d::Zero());
}

Frame hand_frame(int k) {
  static const HollowScene scene;
  static std::vector<GrayImage> images;
  for (int i = int(images.size()); i <= k; ++i)
    images.push_back(scene.render(slow_hand_at(kStep * i), 1, 0, 1.5, uint64_t(i + 1)));
  return {k, Timestamp::from_seconds(kStep * k), images[size_t(k)]};
}

struct Conditions {
  int black_begin = 0, black_end = 0;
  std::function<void(GyroSample*)> change = [](GyroSample*) {};
};

struct HandRun {
  Run run;
  GyroState gyro;
  // Errors of the headings of frames without a pose, against the pose before, degrees.
  std::vector<double> heading_errors, heading_sigmas;
};

HandRun run_hand(const SimulatedGyro& gyro, const Conditions& conditions = {}) {
  HandRun result;
  Odometry odometry(HollowScene().camera);
  size_t next = 0;
  std::optional<Eigen::Quaterniond> R_cam_map;  // of the last pose
  int last = 0;
  for (int k = 0; k < kFrames; ++k) {
    Frame frame = hand_frame(k);
    for (; next < gyro.samples.size() && gyro.samples[next].time.seconds() < kStep * k + 0.1; ++next) {
      GyroSample sample = gyro.samples[next];
      conditions.change(&sample);
      odometry.add_gyro(sample);
    }
    if (k >= conditions.black_begin && k < conditions.black_end)
      std::fill(frame.image.pixels.begin(), frame.image.pixels.end(), uint8_t(0));
    odometry.process(frame);
    const NewestPose& pose = odometry.newest_pose();
    if (pose.T_cam_map) R_cam_map = pose.T_cam_map->rotation(), last = k;
    if (!pose.heading || !R_cam_map) continue;
    const Eigen::Quaterniond truth =
        slow_hand_at(kStep * k).rotation().conjugate() * slow_hand_at(kStep * last).rotation();
    const Eigen::Quaterniond found = pose.heading->R_cam_map * R_cam_map->conjugate();
    result.heading_errors.push_back(deg(rotation_vector(found * truth.conjugate()).norm()));
    result.heading_sigmas.push_back(deg(std::sqrt(pose.heading->covariance.trace())));
  }
  result.gyro = odometry.gyro();
  result.run = odometry.finish();
  return result;
}

SimulatedGyro phone() { return simulate_gyro(slow_hand_at, 0, kStep * kFrames + 0.5, "phone", 3); }

double error_of(const Run& run) {
  return trajectory_error(run, 0, kFrames, [](int k) { return slow_hand_at(kStep * k); }).rmse;
}

TEST(Gyro, HowItSitsIsFoundWithinSeconds) {
  const SimulatedGyro gyro = phone();
  const HandRun hand = run_hand(gyro);
  ASSERT_TRUE(hand.gyro.model) << hand.gyro.statement;
  EXPECT_THAT(hand.gyro.statement, HasSubstr("turned by"));
  EXPECT_LT(deg(rotation_vector(hand.gyro.model->R_cam_gyro * gyro.truth.R_cam_gyro.conjugate()).norm()), 2);
  // Of five seconds of a slow hand, with a clock that may gain, it is known to 10 ms.
  const double offset_sigma = std::sqrt(hand.gyro.model->covariance(kGyroOffset, kGyroOffset));
  EXPECT_LT(offset_sigma, 0.015);
  EXPECT_NEAR(hand.gyro.model->offset_s, gyro.truth.offset_s, 2 * offset_sigma);
  EXPECT_LT(error_of(hand.run), 1.1 * error_of(run_hand(SimulatedGyro()).run));
}

TEST(Gyro, TheHeadingIsKeptThroughABlackoutAndTheMapIsFoundAgain) {
  Conditions dark;
  dark.black_begin = 70, dark.black_end = 90;
  const HandRun hand = run_hand(phone(), dark);
  ASSERT_GE(hand.heading_errors.size(), 15u);
  for (const double error : hand.heading_errors) EXPECT_LT(error, 1.5);
  EXPECT_GT(hand.heading_sigmas.back(), hand.heading_sigmas.front());
  EXPECT_EQ(hand.run.frames.back().segment, 0);
  EXPECT_EQ(hand.run.frames.back().state, TrackingState::kTracking);
}

TEST(Gyro, OneThatDoesNotTurnWithTheCameraIsNamedAndDoesNoHarm) {
  const double without = error_of(run_hand(SimulatedGyro()).run);
  Conditions mirrored, stuck;
  mirrored.change = [](GyroSample* s) { s->rate.x() *= -1; };
  stuck.change = [](GyroSample* s) { s->rate.setZero(); };
  const HandRun by_mirrored = run_hand(phone(), mirrored), by_stuck = run_hand(phone(), stuck);
  EXPECT_THAT(by_mirrored.gyro.statement, HasSubstr("mirrored"));
  EXPECT_LT(error_of(by_mirrored.run), 1.3 * without);
  EXPECT_THAT(by_stuck.gyro.statement, HasSubstr("stuck"));
  EXPECT_EQ(error_of(by_stuck.run), without);
}

// It was believed until then: the images must go on showing that it is wrong.
TEST(Gyro, OneThatIsMirroredAmidTheRunIsNamedAndDoesNoHarm) {
  const double without = error_of(run_hand(SimulatedGyro()).run);
  Conditions mirrored;
  mirrored.change = [](GyroSample* s) {
    if (s->time.seconds() > kStep * 55) s->rate.x() *= -1;
  };
  const HandRun hand = run_hand(phone(), mirrored);
  EXPECT_THAT(hand.gyro.statement, HasSubstr("mirrored"));
  EXPECT_LT(error_of(hand.run), 2 * without);  // four images: the first are taken for outliers
}

// Error of a run of a hand that shakes, whose rolling shutter is known.
double error_of_shaking(const std::vector<GyroSample>& gyro) {
  constexpr double kReadoutS = 0.03;
  OdometryParams params;
  params.camera.readout_s = kReadoutS;
  HandSource source(kReadoutS, gyro);
  Odometry odometry(source.camera(), params);
  size_t next = 0;
  while (const std::optional<Frame> frame = source.next()) {
    for (; next < gyro.size() && seconds_between(frame->time, gyro[next].time) < 0.1; ++next)
      odometry.add_gyro(gyro[next]);
    odometry.process(*frame);
  }
  return trajectory_error(odometry.finish(), 0, kHandFrames, hand_at_frame).rmse;
}

// It bends the rows, and with them the map, so that frames are doubted, and none of these shows that it is
// wrong: they are seen again without it.
TEST(Gyro, OneWhoseAxesAreSwappedAmidTheRunIsFoundInAMapThatItBends) {
  const double without = error_of_shaking({});
  std::vector<GyroSample> gyro = phone_in_hand();
  EXPECT_LT(error_of_shaking(gyro), without);
  for (GyroSample& s : gyro)
    if (s.time.seconds() > 3) std::swap(s.rate.x(), s.rate.y());
  EXPECT_LT(error_of_shaking(gyro), 2.5 * without);  // its first frames
}

}  // namespace
}  // namespace edgevo::test
