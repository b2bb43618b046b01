// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drive_over_ground.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/run_scale.h"

namespace edgevo {
namespace {

using test::drive_over_ground;
using test::GroundDrive;
using test::MadeRun;

const ScaleSource kHeight{ScaleSource::Kind::kCameraHeight, 1.65, "camera_height=1.65"};

MadeRun in_metres(const GroundDrive& drive) {
  MadeRun made = drive_over_ground(drive);
  const RunScale scale = estimate_run_scale(made.run, kHeight, {}, ScaleParams());
  EXPECT_EQ(scale.problem, "");
  if (scale.problem.empty()) make_metric(scale, {}, kHeight, &made.run);
  return made;
}

double true_length(const MadeRun& made) { return 0.5 * double(made.truth.size() - 1); }

TEST(CameraHeight, LengthsComeOutInMetres) {
  const MadeRun made = in_metres({});
  EXPECT_TRUE(made.run.is_metric());
  EXPECT_NEAR(test::length_of(made.run), true_length(made), 0.01 * true_length(made));
  EXPECT_LT(std::abs(made.run.scale.factor / 2 - 1), 3 * made.run.scale.sigma);
  EXPECT_LT(made.run.scale.sigma, 0.03);
}

TEST(CameraHeight, PitchOfTheCameraDoesNotMatter) {
  for (const double pitch : {-0.1, 0.1}) {
    GroundDrive drive;
    drive.pitch = pitch;
    EXPECT_NEAR(in_metres(drive).run.scale.factor, 2, 0.02) << pitch;
  }
}

// The unit grows by a quarter along the path: a single factor would leave metres of error.
TEST(CameraHeight, DriftIsTakenOutWhereItAroseInPosesAndPoints) {
  GroundDrive drive;
  drive.metres_per_unit_begin = 1.8, drive.metres_per_unit_end = 2.3;
  const MadeRun made = in_metres(drive);
  EXPECT_LT(test::largest_error(made.run, made.truth), 0.02 * true_length(made));
  for (const size_t k : {size_t(0), made.run.keyframes.size() - 1}) {
    const KeyframeRecord& keyframe = made.run.keyframes[k];
    const auto& frame = *made.run.frames[size_t(keyframe.frame_index)].T_world_cam;
    EXPECT_LT((keyframe.T_world_cam.translation() - frame.translation()).norm(), 1e-9)
        << "a keyframe is where its frame is";
    double deepest = 0;
    for (const EdgePoint& p : keyframe.points) deepest = std::max(deepest, 1.0 / double(p.idepth));
    EXPECT_NEAR(deepest, 14.5, 1.3) << "points lie from 5 to 15 m ahead, keyframe " << k;
  }
}

TEST(CameraHeight, GroundIsFoundAmongMostlyObstacles) {
  GroundDrive drive;
  drive.ground_share = 0.35;
  EXPECT_NEAR(in_metres(drive).run.scale.factor, 2, 0.04);
}

TEST(CameraHeight, WithoutGroundThereIsNoScale) {
  GroundDrive drive;
  drive.ground_share = 0;
  const MadeRun made = drive_over_ground(drive);
  const RunScale scale = estimate_run_scale(made.run, kHeight, {}, ScaleParams());
  EXPECT_TRUE(scale.of_frame.empty());
  EXPECT_NE(scale.problem.find("no ground"), std::string::npos);
}

TEST(CameraHeight, DegenerateRunsGiveNoScaleAndDoNotCrash) {
  EXPECT_FALSE(estimate_run_scale(edgevo::Run(), kHeight, {}, ScaleParams()).problem.empty());
  GroundDrive one;
  one.frames = 2;
  EXPECT_FALSE(estimate_run_scale(drive_over_ground(one).run, kHeight, {}, ScaleParams()).problem.empty());
  MadeRun still = drive_over_ground({});
  for (FrameRecord& f : still.run.frames) f.T_world_cam = SE3();
  for (KeyframeRecord& k : still.run.keyframes) k.T_world_cam = SE3();
  EXPECT_FALSE(estimate_run_scale(still.run, kHeight, {}, ScaleParams()).problem.empty());
}

// A segment without visible ground takes the scale of the one before, marked as not measured.
TEST(CameraHeight, ASegmentWithoutGroundTakesItsNeighboursScale) {
  MadeRun made = drive_over_ground({});
  for (FrameRecord& f : made.run.frames) f.segment = f.index >= 200;
  for (KeyframeRecord& k : made.run.keyframes)
    if ((k.segment = k.frame_index >= 200) == 1) k.points.clear();
  const RunScale scale = estimate_run_scale(made.run, kHeight, {}, ScaleParams());
  ASSERT_FALSE(scale.of_frame.empty());
  EXPECT_EQ(scale.of_frame.back().samples, 0);
  EXPECT_NEAR(scale.of_frame.back().factor, 2, 0.04);
  make_metric(scale, {}, kHeight, &made.run);
  EXPECT_EQ(made.run.scale.frames_carried_over, 100);
}

// What is known when a frame arrives, from the past only: nothing at first, then the final scale to within
// its standard deviation.
TEST(CameraHeight, LiveScaleConverges) {
  const MadeRun made = drive_over_ground({});
  LiveScale live(made.run.pinhole, kHeight, {}, std::nullopt, ScaleParams());
  constexpr size_t kWindow = 16;  // keyframes are marginalised that much later
  size_t marginalised = 0;
  for (const FrameRecord& f : made.run.frames) {
    live.add_frame(f);
    for (; marginalised + kWindow < size_t(f.index) / 2; ++marginalised)
      live.add_keyframe(int(marginalised), made.run.keyframes[marginalised]);
  }
  ASSERT_EQ(live.history().size(), made.run.frames.size());
  EXPECT_FALSE(live.history().front());
  ASSERT_TRUE(live.newest());
  EXPECT_NEAR(live.newest()->factor, 2, 0.04);
  edgevo::Run run = made.run;
  make_metric(estimate_run_scale(run, kHeight, {}, ScaleParams()), live.history(), kHeight, &run);
  EXPECT_NEAR(run.frames.back().T_world_cam_live->translation().norm(),
              made.truth.back().translation().norm(), 3);
  EXPECT_EQ(run.scale.frames.front().live_factor, 0) << "not yet known";
}

// A camera that drives backwards over hills sees the ground that it has passed, metres away and elsewhere in
// height: what counts is how high it was over each point.
TEST(CameraHeight, BackwardsAPointIsMeasuredWhereItWasPassed) {
  const auto ground = [](double z) { return 0.5 * std::sin(z / 6); };
  Path path;
  for (int i = 0; i < 120; ++i) {
    const double z = 60 - 0.5 * i;
    extend(i, Timestamp::from_seconds(0.1 * i),
           SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, ground(z) - 1.65, z)), &path);
  }
  const Pinhole pinhole{700, 700, 600, 200, 1200, 400};
  KeyframeRecord keyframe;
  keyframe.frame_index = 60;
  const Eigen::Vector3d host = path[60].T_world_cam.translation();
  for (double z = host.z() + 4; z < host.z() + 12; z += 0.25) {
    const Eigen::Vector3d p_cam = Eigen::Vector3d(0.3, ground(z), z) - host;
    EdgePoint point;
    point.px = pinhole.project(p_cam).cast<float>();
    point.normal = {1, 0};
    point.idepth = float(1 / p_cam.z());
    point.idepth_sigma = 0.01F * point.idepth;
    point.observations = 4;
    keyframe.points.push_back(point);
  }
  const std::vector<HeightSample> heights =
      ground_heights(pinhole, keyframe, Eigen::Vector3d::UnitY(), path, true, ScaleParams());
  EXPECT_GT(heights.size(), 20u);
  for (const HeightSample& h : heights) EXPECT_NEAR(h.height, 1.65, 0.05) << h.distance;
}

// What the heights of an interval have in common is not averaged out by their number: the ground rises and
// falls by 5 % from one interval of 8 metres to the next.
TEST(CameraHeight, TheStandardDeviationIsThatOfIntervalsNotOfPoints) {
  std::vector<HeightSample> even, wavy;
  for (int i = 0; i < 2000; ++i) {
    const double distance = 0.02 * i, wave = 0.05 * std::sin(distance * 2 * M_PI / 16);
    even.push_back({distance, 1.65 * (1 + 0.02 * std::sin(1.7 * i))});
    wavy.push_back({distance, even.back().height * (1 + wave)});
  }
  ScaleParams params;
  params.ground_sigma = 0;
  const auto a = fit_height(even, 1.65, params), b = fit_height(wavy, 1.65, params);
  ASSERT_TRUE(a && b);
  EXPECT_LT(a->sigma, 0.003);
  EXPECT_GT(b->sigma, 0.008);
}

}  // namespace
}  // namespace edgevo
