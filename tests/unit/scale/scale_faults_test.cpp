// SPDX-License-Identifier: BSD-3-Clause
// Several sources of scale over one drive: which counts, and which is named, where they contradict.
#include <gtest/gtest.h>

#include "drive_over_ground.h"
#include "edgevo/scale/live_scale.h"
#include "edgevo/scale/run_scale.h"
#include "support/vehicle_sensors.h"

namespace edgevo {
namespace {

using test::drive_over_ground;
using test::GpsJump;
using test::GroundDrive;
using test::MadeRun;
using test::SensorNoise;
using test::WheelSlip;

// 400 m, over which the unit drifts by 4 %.
GroundDrive long_drive() {
  GroundDrive drive;
  drive.frames = 800;
  drive.metres_per_unit_begin = 1.96, drive.metres_per_unit_end = 2.04;
  return drive;
}

class SeveralSources : public ::testing::Test {
 protected:
  static test::TimedPath path() {
    test::TimedPath path;
    for (const FrameRecord& frame : made_.run.frames) path.times.push_back(frame.time);
    path.poses = made_.truth;
    return path;
  }
  void wheels(const WheelSlip& slip = {}) {
    tracks_[VehicleSensor::kOdometry] = test::wheels_of(path(), noise_, slip);
  }
  void gps(const GpsJump& jump = {}) { tracks_[VehicleSensor::kGps] = test::gps_of(path(), noise_, jump); }
  RunScale estimate(const std::string& sources) const {
    return estimate_run_scale(made_.run, parse_scale_sources(sources), tracks_, ScaleParams());
  }
  // Largest over the frames, relative.
  static double largest_error(const RunScale& scale) {
    double largest = 0;
    for (size_t i = 0; i < scale.of_frame.size(); ++i)
      largest = std::max(largest, std::abs(scale.of_frame[i].factor / test::unit_at(kDrive, int(i)) - 1));
    return largest;
  }
  // Over the whole drive.
  static double length_error(const RunScale& scale, const std::string& sources) {
    edgevo::Run run = made_.run;
    make_metric(scale, {}, parse_scale_sources(sources), &run);
    return test::length_of(run) / (0.5 * (kDrive.frames - 1)) - 1;
  }

  inline static const GroundDrive kDrive = long_drive();
  inline static const MadeRun made_ = drive_over_ground(kDrive);
  SensorNoise noise_;
  VehicleTracks tracks_;
};

TEST_F(SeveralSources, HonestOnesAreNotNamed) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    noise_.seed = seed;
    wheels(), gps();
    for (const char* sources : {"odometry,gps", "odometry", "gps", "camera_height=1.65,odometry"}) {
      const RunScale scale = estimate(sources);
      EXPECT_TRUE(scale.faults.empty()) << sources << ", seed " << seed << ": " << scale.faults.size();
      for (const auto& [source, clock] : scale.clock_offsets)
        ADD_FAILURE() << sources << ", seed " << seed << ": " << source << " " << clock.late_s << " +- "
                      << clock.sigma_s;
      EXPECT_LT(std::abs(length_error(scale, sources)), 0.01) << sources << ", seed " << seed;
    }
  }
}

TEST_F(SeveralSources, AreMoreCertainThanOne) {
  wheels(), gps();
  const double both = estimate("odometry,gps").of_frame[400].sigma;
  EXPECT_LT(both, estimate("odometry").of_frame[400].sigma);
  EXPECT_LT(both, estimate("gps").of_frame[400].sigma);
}

// A fifth of the drive.
TEST_F(SeveralSources, WheelsThatSlipAreOutvotedAndNamed) {
  for (const double at : {0.0, 0.4, 0.8})
    for (const double factor : {1.05, 1.2, 1.5, 0.8}) {
      wheels({at, at + 0.2, factor}), gps();
      const RunScale scale = estimate("odometry,gps");
      EXPECT_LT(std::abs(length_error(scale, "odometry,gps")), 0.01) << factor << " at " << at;
      EXPECT_LT(largest_error(scale), 0.03) << factor << " at " << at;
      ASSERT_EQ(scale.faults.size(), 1u) << factor << " at " << at;
      const ScaleFault& fault = scale.faults.front();
      EXPECT_EQ(fault.source, "odometry");
      EXPECT_NEAR(fault.first_frame, 800 * at, 25) << factor << " at " << at;
      EXPECT_NEAR(fault.last_frame, 800 * (at + 0.2), 25) << factor << " at " << at;
      EXPECT_NEAR(fault.log_excess, std::log(factor), 0.02);
      EXPECT_EQ(fault.displacement, 0);
    }
}

TEST_F(SeveralSources, AGpsThatJumpsIsNamedAndGoesOnToCount) {
  for (const double at : {0.0, 0.1, 0.45, 0.95})
    for (const double metres : {5.0, 15.0, 50.0}) {
      gps({at, 5, metres});
      const RunScale scale = estimate("gps");
      EXPECT_LT(std::abs(length_error(scale, "gps")), 0.01) << metres << " m at " << at;
      ASSERT_EQ(scale.faults.size(), 1u) << metres << " m at " << at;
      const ScaleFault& fault = scale.faults.front();
      EXPECT_EQ(fault.source, "gps");
      EXPECT_NEAR(fault.first_frame, 800 * at, 1);
      EXPECT_NEAR(fault.last_frame, std::min(800 * at + 49, 799.0), 1);
      EXPECT_NEAR(fault.displacement, metres, 0.1 * metres);
    }
}

TEST_F(SeveralSources, SingleFixesThatJumpAreNamed) {
  gps();
  tracks_[VehicleSensor::kGps].positions[300].position += Eigen::Vector3d(8, 0, 0);
  const RunScale scale = estimate("gps");
  ASSERT_EQ(scale.faults.size(), 1u);
  EXPECT_EQ(scale.faults[0].first_frame, 300);
  EXPECT_EQ(scale.faults[0].last_frame, 300);
}

TEST_F(SeveralSources, BothMayLieOneAfterTheOther) {
  wheels({0.6, 0.8, 1.2}), gps({0.2, 5, 15});
  const RunScale scale = estimate("odometry,gps");
  EXPECT_LT(std::abs(length_error(scale, "odometry,gps")), 0.01);
  ASSERT_EQ(scale.faults.size(), 2u);
  EXPECT_EQ(scale.faults[0].source, "odometry");
  EXPECT_EQ(scale.faults[1].source, "gps");
}

// While GPS is away, nothing but the steadiness of the unit contradicts the wheels.
TEST_F(SeveralSources, ContinuityOutvotesASlipWhereNothingElseMeasures) {
  wheels({0.45, 0.55, 1.3}), gps();
  tracks_[VehicleSensor::kGps] = test::without(tracks_[VehicleSensor::kGps], 0.4, 0.6);
  const RunScale scale = estimate("odometry,gps");
  EXPECT_LT(std::abs(length_error(scale, "odometry,gps")), 0.01);
  ASSERT_EQ(scale.faults.size(), 1u);
  EXPECT_GT(scale.of_frame[400].sigma, 2 * scale.of_frame[200].sigma);
  EXPECT_EQ(scale.of_frame[400].samples, 0);
}

TEST_F(SeveralSources, OneThatFitsNowhereIsNamed) {
  wheels(), gps();
  tracks_[VehicleSensor::kOdometry] = test::delayed(tracks_[VehicleSensor::kOdometry], 1000);
  const RunScale scale = estimate("odometry,gps");
  EXPECT_EQ(scale.problem, "");
  EXPECT_LT(std::abs(length_error(scale, "odometry,gps")), 0.01);
  ASSERT_EQ(scale.faults.size(), 1u);
  EXPECT_EQ(scale.faults[0].source, "odometry");
  EXPECT_EQ(scale.faults[0].log_excess_sigma, 0);
}

TEST_F(SeveralSources, NoneThatFitsIsAProblemThatNamesEach) {
  const RunScale scale = estimate("odometry,gps");
  EXPECT_TRUE(scale.of_frame.empty());
  EXPECT_NE(scale.problem.find("odometry: its positions"), std::string::npos) << scale.problem;
  EXPECT_NE(scale.problem.find("gps: its positions"), std::string::npos) << scale.problem;
}

// A drive that brakes and speeds up.
class Clocks : public ::testing::Test {
 protected:
  static GroundDrive drive(double speed_changes) {
    GroundDrive drive = long_drive();
    drive.speed_changes = speed_changes;
    return drive;
  }
  static test::TimedPath path_of(const MadeRun& made) {
    test::TimedPath path;
    for (const FrameRecord& frame : made.run.frames) path.times.push_back(frame.time);
    path.poses = made.truth;
    return path;
  }
  static RunScale estimate(const MadeRun& made, const std::string& source, const VehicleTracks& tracks) {
    return estimate_run_scale(made.run, parse_scale_sources(source), tracks, ScaleParams());
  }
};

TEST_F(Clocks, ThatAreOffAreFoundAndCorrected) {
  const MadeRun made = drive_over_ground(drive(0.5));
  for (const double late : {0.5, -0.3, 1.8})
    for (unsigned seed = 1; seed <= 3; ++seed)
      for (const char* source : {"odometry", "gps"}) {
        const SensorNoise noise{0.02, 0.5, seed};
        const VehicleTracks tracks{
            {VehicleSensor::kOdometry, test::delayed(test::wheels_of(path_of(made), noise), late)},
            {VehicleSensor::kGps, test::delayed(test::gps_of(path_of(made), noise), late)}};
        const RunScale scale = estimate(made, source, tracks);
        ASSERT_EQ(scale.clock_offsets.count(source), 1u) << source << " " << late << " s, seed " << seed;
        const ClockOffset& clock = scale.clock_offsets.at(source);
        EXPECT_NEAR(clock.late_s, late, 4 * clock.sigma_s + 0.02) << source << ", seed " << seed;
        EXPECT_LT(clock.sigma_s, 0.1) << source << " " << late << " s, seed " << seed;
        EXPECT_TRUE(scale.faults.empty()) << source << " " << late << " s, seed " << seed;
      }
}

TEST_F(Clocks, ThatAreOffByMoreThanIsLookedForAreNotHalfCorrected) {
  const MadeRun made = drive_over_ground(drive(0.5));
  const VehicleTracks tracks{
      {VehicleSensor::kOdometry, test::delayed(test::wheels_of(path_of(made), SensorNoise{}), 3)}};
  EXPECT_TRUE(estimate(made, "odometry", tracks).clock_offsets.empty());
}

// Also of a sensor ahead of the camera, which turns earlier, as one with a clock that is early does.
TEST_F(Clocks, ThatAreRightStayAsTheyAre) {
  for (const double speed_changes : {0.0, 0.5})
    for (const double ahead : {0.0, 1.0}) {
      const MadeRun made = drive_over_ground(drive(speed_changes));
      test::TimedPath path = path_of(made);
      for (SE3& T : path.poses) T = T * SE3(Eigen::Quaterniond::Identity(), {0.3 * ahead, 0, ahead});
      for (unsigned seed = 1; seed <= 10; ++seed) {
        const SensorNoise noise{0.02, 0.5, seed};
        const VehicleTracks tracks{{VehicleSensor::kOdometry, test::wheels_of(path, noise)},
                                   {VehicleSensor::kGps, test::gps_of(path, noise)}};
        for (const auto& [source, clock] : estimate(made, "odometry,gps", tracks).clock_offsets)
          ADD_FAILURE() << source << " " << ahead << " m ahead, seed " << seed << ": " << clock.late_s;
      }
    }
}

// A third of the drive, alone: the unit of the run does not change unsaid. At the beginning of a drive
// nothing says which of the two is right.
TEST_F(SeveralSources, WheelsThatSlipForLongDoNotBendThePath) {
  for (const double factor : {0.7, 1.2, 1.3, 3.0})
    for (const double begin : {0.3, 0.67}) {
      wheels({begin, begin + 0.33, factor});
      const RunScale scale = estimate("odometry");
      EXPECT_LT(std::abs(length_error(scale, "odometry")), 0.015) << factor << " at " << begin;
      EXPECT_LT(largest_error(scale), 0.04) << factor << " at " << begin;
      ASSERT_EQ(scale.faults.size(), 1u) << factor << " at " << begin;
      EXPECT_EQ(scale.faults[0].source, "odometry");
      EXPECT_NEAR(scale.faults[0].first_frame, 800 * begin, 40) << factor << " at " << begin;
      EXPECT_NEAR(scale.faults[0].last_frame, 800 * begin + 264, 40) << factor << " at " << begin;
    }
}

// Three fixes of ten are anywhere within tens of metres.
TEST_F(SeveralSources, ScatteredFixesAreExcludedAndCounted) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    noise_.seed = seed;
    gps();
    std::mt19937 random(seed);
    std::normal_distribution<double> metres(0, 20);
    std::bernoulli_distribution is_scattered(0.3);
    int scattered = 0;
    for (VehiclePosition& p : tracks_[VehicleSensor::kGps].positions)
      if (is_scattered(random))
        p.position += Eigen::Vector3d(metres(random), metres(random), metres(random)), ++scattered;
    const RunScale scale = estimate("gps");
    EXPECT_LT(std::abs(length_error(scale, "gps")), 0.01) << seed;
    EXPECT_LT(largest_error(scale), 0.02) << seed;
    ASSERT_FALSE(scale.faults.empty()) << seed;
    int counted = 0;
    for (const ScaleFault& fault : scale.faults) counted += fault.scattered;
    EXPECT_NEAR(counted, scattered, 0.2 * scattered) << seed;
  }
}

// Fixes of a receiver without any, at latitude 0.
TEST_F(SeveralSources, FixesAtNowhereHideNoOtherSource) {
  wheels(), gps();
  auto& fixes = tracks_[VehicleSensor::kGps].positions;
  for (size_t i = 300; i < 540; ++i) fixes[i].position = {6.3e6, 0, 0};
  EXPECT_LT(std::abs(length_error(estimate("gps"), "gps")), 0.01);
  EXPECT_LT(std::abs(length_error(estimate("odometry,gps"), "odometry,gps")), 0.01);
  for (size_t i = 0; i < fixes.size(); i += 3) fixes[i].position = {6.3e6, 0, 0};
  EXPECT_LT(std::abs(length_error(estimate("odometry,gps"), "odometry,gps")), 0.01);
}

// A camera that is 10 % lower than said.
TEST_F(SeveralSources, AWrongHeightIsOutvotedByTwoOthers) {
  wheels(), gps();
  const RunScale scale = estimate("camera_height=1.815,odometry,gps");
  EXPECT_LT(std::abs(length_error(scale, "odometry,gps")), 0.01);
  ASSERT_FALSE(scale.faults.empty());
  for (const ScaleFault& fault : scale.faults) EXPECT_EQ(fault.source, "camera_height=1.815");
}

// No doubt of the run says so: both sensors do.
TEST_F(SeveralSources, AUnitThatChangesUnseenIsFollowed) {
  MadeRun changed = made_;
  Eigen::Vector3d before = changed.run.frames[399].T_world_cam->translation();
  for (size_t i = 400; i < 800; ++i) {
    SE3& T = *changed.run.frames[i].T_world_cam;
    T = SE3(T.rotation(), before + 1.25 * (T.translation() - before));
  }
  wheels(), gps();
  const RunScale scale =
      estimate_run_scale(changed.run, parse_scale_sources("odometry,gps"), tracks_, ScaleParams());
  EXPECT_NEAR(scale.of_frame[200].factor, test::unit_at(kDrive, 200), 0.02);
  EXPECT_NEAR(scale.of_frame[600].factor, test::unit_at(kDrive, 600) / 1.25, 0.02);
}

TEST_F(SeveralSources, TheLiveScaleIsNotPulledEither) {
  wheels({0.4, 0.6, 1.2}), gps({0.8, 5, 15});
  LiveScale live(made_.run.pinhole, parse_scale_sources("odometry,gps"), tracks_, std::nullopt,
                 ScaleParams());
  for (const FrameRecord& frame : made_.run.frames) live.add_frame(frame);
  for (size_t i = 200; i < 800; ++i) {
    ASSERT_TRUE(live.history()[i]);
    EXPECT_NEAR(live.history()[i]->factor / test::unit_at(kDrive, int(i)), 1, 0.04) << i;
  }
}

}  // namespace
}  // namespace edgevo
