// SPDX-License-Identifier: BSD-3-Clause
// Two sources of scale that disagree, on a real drive: wheels that slip by 20 % over a fifth of it, and GPS
// that jumps by 15 m for five seconds. The sensors are made from the ground truth.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

#include "edgevo/datasets/open_source.h"
#include "edgevo/run_quality/scale_faults.h"
#include "edgevo/scale/run_scale.h"
#include "run_figures.h"
#include "support/vehicle_sensors.h"

namespace edgevo::test {
namespace {

constexpr const char* kSequence = EDGEVO_DATA_DIR "/kitti00_first300";

class DisagreeingSources : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!std::filesystem::is_directory(kSequence) || run_) return;
    SourceOptions options;
    options.path = kSequence;
    run_ = new edgevo::Run(run_source(*open_source(options)));
    for (const StampedPose& pose : read_trajectory(options.path + "/groundtruth_tum.txt").poses)
      path_.times.push_back(pose.time), path_.poses.push_back(pose.T_world_cam);
  }
  void SetUp() override {
    if (!run_)
      GTEST_SKIP() << "NOT TESTED: there is no " << kSequence << "; configure with -DEDGEVO_DATA_DIR=DIR";
  }

  // Length of the path over that of the truth, less 1.
  static double length_error(const edgevo::Run& run) {
    double length = 0, truth = 0;
    for (size_t i = 1; i < run.frames.size(); ++i) {
      if (!run.frames[i - 1].T_world_cam || !run.frames[i].T_world_cam) continue;
      length +=
          (run.frames[i].T_world_cam->translation() - run.frames[i - 1].T_world_cam->translation()).norm();
      truth += (path_.poses[i].translation() - path_.poses[i - 1].translation()).norm();
    }
    return length / truth - 1;
  }

  static edgevo::Run in_metres(const VehicleTracks& tracks) {
    edgevo::Run run = *run_;
    const ScaleSources sources = parse_scale_sources("odometry,gps");
    const RunScale scale = estimate_run_scale(run, sources, tracks, ScaleParams());
    EXPECT_EQ(scale.problem, "");
    if (scale.problem.empty()) make_metric(scale, {}, sources, &run);
    std::cout << "[ figures  ] length off by " << 100 * length_error(run) << " %, sigma "
              << 100 * run.scale.sigma << " %" << std::endl;
    for (const std::string& line : scale_faults_in_words(run))
      std::cout << "[ figures  ] " << line << std::endl;
    return run;
  }

  inline static edgevo::Run* run_ = nullptr;
  inline static TimedPath path_;
};

TEST_F(DisagreeingSources, HonestOnesAreNotNamed) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SensorNoise noise;
    noise.seed = seed;
    const edgevo::Run run = in_metres(
        {{VehicleSensor::kOdometry, wheels_of(path_, noise)}, {VehicleSensor::kGps, gps_of(path_, noise)}});
    EXPECT_LT(std::abs(length_error(run)), 0.01);
    EXPECT_TRUE(run.scale.faults.empty());
  }
}

TEST_F(DisagreeingSources, WheelsThatSlipAreNamedAndTheMetreIsRight) {
  for (const double begin : {0.0, 0.4, 0.8}) {
    const edgevo::Run run =
        in_metres({{VehicleSensor::kOdometry, wheels_of(path_, {}, {begin, begin + 0.2, 1.2})},
                   {VehicleSensor::kGps, gps_of(path_, {})}});
    EXPECT_LT(std::abs(length_error(run)), 0.01);
    ASSERT_EQ(run.scale.faults.size(), 1u);
    EXPECT_EQ(run.scale.faults[0].source, "odometry");
    EXPECT_NEAR(run.scale.faults[0].first_frame, 300 * begin, 20);
    EXPECT_NEAR(run.scale.faults[0].last_frame, 300 * (begin + 0.2), 20);
    EXPECT_NEAR(run.scale.faults[0].log_excess, std::log(1.2), 0.03);
  }
}

TEST_F(DisagreeingSources, GpsThatJumpsIsNamedAndTheMetreIsRight) {
  const edgevo::Run run = in_metres({{VehicleSensor::kOdometry, wheels_of(path_, {}, {0.7, 0.9, 1.2})},
                                     {VehicleSensor::kGps, gps_of(path_, {}, {0.2, 5, 15})}});
  EXPECT_LT(std::abs(length_error(run)), 0.01);
  ASSERT_EQ(run.scale.faults.size(), 2u);
  EXPECT_EQ(run.scale.faults[1].source, "gps");
  EXPECT_NEAR(run.scale.faults[1].first_frame, 60, 2);
  EXPECT_NEAR(run.scale.faults[1].last_frame, 108, 3);
  EXPECT_NEAR(run.scale.faults[1].displacement, 15, 1.5);
}

}  // namespace
}  // namespace edgevo::test
