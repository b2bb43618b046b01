// SPDX-License-Identifier: BSD-3-Clause
// Self-calibration on trajectories with exact truth: matches as a lens with a known residual distortion
// yields them.
#include "edgevo/self_calibration/self_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/map/corrected_pixel.h"
#include "support/synthetic_drive.h"

namespace edgevo {
namespace {

using test::calibrate;
using test::make_drive;
using test::map_of;
using test::SyntheticDrive;
using Outcome = test::CalibratedDrive;
using State = CameraPosterior::State;

State k1_state(const CameraPosterior& c) { return c.state_of(CameraNumber::kK1); }
State readout_state(const CameraPosterior& c) { return c.state_of(CameraNumber::kReadout); }
State focal_state(const CameraPosterior& c) { return c.state_of(CameraNumber::kFocal); }

TEST(SelfCalibration, FindsTheDistortion) {
  for (const double k1 : {0.01, -0.008, 0.02})
    for (const uint64_t seed : {1, 2, 3}) {
      SyntheticDrive o;
      o.k1 = k1, o.seed = seed;
      const Outcome out = calibrate(o);
      EXPECT_EQ(k1_state(out.state), State::kApplied);
      EXPECT_NEAR(out.state.applied.k1, k1, 0.001);
      ASSERT_TRUE(out.moved);
      EXPECT_EQ(out.moved->lens->now.k1, out.state.applied.k1);
      EXPECT_EQ(readout_state(out.state), State::kInsignificant);
      EXPECT_EQ(out.state.applied.readout_s, 0);
    }
}

TEST(SelfCalibration, FindsARollingShutter) {
  for (const double readout_s : {0.02, -0.015, 0.03})
    for (const double k1 : {0.0, 0.012}) {
      SyntheticDrive o;
      o.k1 = k1, o.readout_s = readout_s;
      const Outcome out = calibrate(o);
      EXPECT_EQ(readout_state(out.state), State::kApplied) << readout_s << " " << k1;
      EXPECT_NEAR(out.state.given.mean_of(CameraNumber::kReadout), readout_s, 0.001);
      EXPECT_NEAR(out.state.applied.readout_s, 1.5 * readout_s, 0.0015)
          << "applied with over-relaxation: distorted rows bias the estimates";
      EXPECT_EQ(k1_state(out.state), k1 == 0 ? State::kInsignificant : State::kApplied);
      EXPECT_NEAR(out.state.given.mean_of(CameraNumber::kK1), k1, 0.002);
      ASSERT_TRUE(out.moved);
      EXPECT_EQ(out.moved->lens->now, out.state.applied);
    }
}

TEST(SelfCalibration, WithoutOverRelaxationTheEstimateIsApplied) {
  SyntheticDrive o;
  o.readout_s = 0.02;
  SelfCalibrationParams params;
  params.over_relax_readout = false;
  EXPECT_NEAR(calibrate(o, params).state.applied.readout_s, 0.02, 0.001);
}

// With few keyframes, long before k1 shows.
TEST(SelfCalibration, ARollingShutterShowsEarly) {
  SyntheticDrive o;
  o.keyframes = 14;
  o.readout_s = 0.02;
  const Outcome out = calibrate(o);
  EXPECT_EQ(readout_state(out.state), State::kApplied);
  EXPECT_NEAR(out.state.given.mean_of(CameraNumber::kReadout), 0.02, 0.002);
  EXPECT_EQ(k1_state(out.state), State::kInsignificant);
  EXPECT_EQ(out.state.applied.k1, 0);
}

// Matches scatter where rows are not straight yet.
TEST(SelfCalibration, ARollingShutterShowsEarlyThroughScatteredMatches) {
  for (const uint64_t seed : {1, 2, 3, 4, 5}) {
    SyntheticDrive o;
    o.keyframes = 15, o.readout_s = 0.02;
    o.noise_px = 1.5, o.step = 0.11, o.seed = seed;
    const Outcome out = calibrate(o);
    EXPECT_EQ(readout_state(out.state), State::kApplied) << seed;
    EXPECT_LT(out.state.given.sigma_of(CameraNumber::kReadout), 0.0035);
  }
}

TEST(SelfCalibration, EstimatesOnlyWhatIsRequested) {
  SyntheticDrive o;
  o.k1 = 0.012, o.readout_s = 0.02;
  SelfCalibrationParams params;
  params.refine = "k1";
  const CameraPosterior lens = calibrate(o, params).state;
  EXPECT_EQ(readout_state(lens), State::kOff);
  EXPECT_EQ(lens.applied.readout_s, 0);
  params.refine = "readout";
  const CameraPosterior shutter = calibrate(o, params).state;
  EXPECT_EQ(readout_state(lens), State::kOff);
  EXPECT_EQ(shutter.applied.k1, 0);
  EXPECT_EQ(readout_state(shutter), State::kApplied);
  params.refine = "none";
  params.readout_s = 0.02;  // known: used as it is
  EXPECT_EQ(calibrate(o, params).state.applied, (ImageCorrection{0, 0.02}));
}

// Bad light may suggest a rolling shutter where there is none: later keyframes reset it, also after it was
// applied.
TEST(SelfCalibration, AFalseShutterIsGivenUp) {
  SyntheticDrive rolling, still;
  rolling.keyframes = 14, rolling.readout_s = 0.02;
  still.keyframes = 60;
  const std::vector<Keyframe> mistaken = make_drive(rolling);
  SelfCalibration calibration(test::pinhole(), {});
  ASSERT_TRUE(calibration.estimate(map_of(mistaken, mistaken.size()), BaOptions(), true));
  const ImageCorrection mistake = calibration.state().applied;
  ASSERT_GT(mistake.readout_s, 0.015);
  calibration.cancel();
  std::vector<Keyframe> drive = make_drive(still);
  for (Keyframe& k : drive)
    for (MapPoint& p : k.points) {
      p.px = correct_pixel(test::pinhole(), {}, mistake, k.motion, p.px);
      for (Observation& seen : p.observations)
        seen.match.px = correct_pixel(test::pinhole(), {}, mistake,
                                      drive[size_t(seen.keyframe_id - 10)].motion, seen.match.px);
    }
  const auto moved = calibration.estimate(map_of(drive, drive.size()), BaOptions(), true);
  EXPECT_EQ(readout_state(calibration.state()), State::kInsignificant);
  EXPECT_EQ(calibration.state().applied.readout_s, 0);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->lens->before, mistake);
  EXPECT_EQ(moved->lens->now, ImageCorrection());
}

// Matches as they lie under a correction that was applied.
std::vector<Keyframe> corrected_by(const ImageCorrection& applied, std::vector<Keyframe> drive) {
  for (Keyframe& k : drive)
    for (MapPoint& p : k.points) {
      p.px = correct_pixel(test::pinhole(), {}, applied, k.motion, p.px);
      for (Observation& seen : p.observations)
        seen.match.px = correct_pixel(test::pinhole(), {}, applied,
                                      drive[size_t(seen.keyframe_id - 10)].motion, seen.match.px);
    }
  return drive;
}

// The first keyframes had a distortion that the later ones have not.
TEST(SelfCalibration, ADistortionThatLaterKeyframesContradictIsTakenBack) {
  SyntheticDrive first;
  first.k1 = 0.012;
  SelfCalibration calibration(test::pinhole(), {});
  const std::vector<Keyframe> mistaken = make_drive(first);
  ASSERT_TRUE(calibration.estimate(map_of(mistaken, mistaken.size()), BaOptions(), true));
  const ImageCorrection mistake = calibration.state().applied;
  ASSERT_GT(mistake.k1, 0.009);
  calibration.cancel();
  SyntheticDrive later;
  later.keyframes = 80;
  const std::vector<Keyframe> drive = corrected_by(mistake, make_drive(later));
  const auto moved = calibration.estimate(map_of(drive, drive.size()), BaOptions(), true);
  ASSERT_TRUE(moved);
  EXPECT_LT(std::abs(moved->lens->now.k1), 0.001);
}

// Images that are corrected already: the estimate is of the whole read-out time, not of the rest.
TEST(SelfCalibration, AKnownShutterIsConfirmed) {
  SyntheticDrive o;
  o.readout_s = 0.02;
  std::vector<Keyframe> drive = make_drive(o);
  SelfCalibrationParams params;
  params.readout_s = 0.015;
  const ImageCorrection none, applied{0, params.readout_s};
  for (Keyframe& k : drive)
    for (MapPoint& p : k.points) {
      p.px = correct_pixel(test::pinhole(), none, applied, k.motion, p.px);
      for (Observation& seen : p.observations)
        seen.match.px = correct_pixel(test::pinhole(), none, applied,
                                      drive[size_t(seen.keyframe_id - 10)].motion, seen.match.px);
    }
  SelfCalibration calibration(test::pinhole(), params);
  calibration.estimate(map_of(drive, drive.size()), BaOptions(), true);
  EXPECT_NEAR(calibration.state().given.mean_of(CameraNumber::kReadout), 0.02, 0.001);
}

TEST(SelfCalibration, LeavesAGoodCameraAlone) {
  for (const uint64_t seed : {1, 2, 3, 4}) {
    SyntheticDrive o;
    o.seed = seed;
    const Outcome out = calibrate(o);
    EXPECT_EQ(k1_state(out.state), State::kInsignificant);
    EXPECT_LT(std::abs(out.state.given.mean_of(CameraNumber::kK1)), 0.001);
    EXPECT_EQ(out.state.applied.k1, 0);
    EXPECT_FALSE(out.moved);
  }
}

TEST(SelfCalibration, ReportsWhenNothingIsObservable) {
  SyntheticDrive still;
  still.step = 0.002;
  still.k1 = 0.01;
  const Outcome out = calibrate(still);
  EXPECT_EQ(k1_state(out.state), State::kNotObservable);
  EXPECT_FALSE(out.moved);

  SyntheticDrive brief;
  brief.keyframes = 9;
  brief.k1 = 0.01;
  EXPECT_EQ(k1_state(calibrate(brief).state), State::kTooEarly);
}

// A drive as an odometry sees it whose camera file has another focal length.
std::vector<Keyframe> seen_by_file(double focal, std::vector<Keyframe> drive) {
  const ImageCorrection file{0, 0, focal};
  for (Keyframe& k : drive)
    for (MapPoint& p : k.points) {
      p.px = correct_pixel(test::pinhole(), file, {}, k.motion, p.px);
      for (Observation& seen : p.observations)
        seen.match.px = correct_pixel(test::pinhole(), file, {}, k.motion, seen.match.px);
    }
  SE3 T_last_world = drive.front().T_cam_world;
  for (size_t i = 1; i < drive.size(); ++i) {
    const SE3 T = drive[i].T_cam_world * T_last_world.inverse();
    T_last_world = drive[i].T_cam_world;
    drive[i].T_cam_world = correct_motion(T, 1 + focal) * drive[i - 1].T_cam_world;
  }
  return drive;
}

double angle_between(const SE3& a, const SE3& b) { return (b * a.inverse()).angle(); }

TEST(SelfCalibration, AppliesTheFocalLengthThatCornersShow) {
  for (const double focal : {0.25, -0.2}) {
    SyntheticDrive o;
    o.keyframes = 20;
    const std::vector<Keyframe> truth = make_drive(o), drive = seen_by_file(focal, truth);
    SelfCalibrationParams params;
    params.refine = "focal";
    SelfCalibration calibration(test::pinhole(), params);
    Map map = map_of(drive, drive.size());
    EXPECT_FALSE(calibration.is_focal_length_due(map));
    calibration.note_focal_length({focal, 0.05, 3});
    ASSERT_TRUE(calibration.is_focal_length_due(map));
    const auto moved = calibration.estimate(map, BaOptions(), false);
    ASSERT_TRUE(moved);
    const double found = moved->lens->now.focal;
    EXPECT_NEAR(found, focal, 0.01) << "corners said so to 5 %";
    EXPECT_EQ(calibration.state().applied.focal, found);
    EXPECT_EQ(focal_state(calibration.state()), State::kApplied);
    EXPECT_FALSE(calibration.is_focal_length_due(map)) << "once";
    const auto pose = [&](size_t i) { return moved->keyframes[i].T_cam_newest; };
    const double turn = angle_between(truth.front().T_cam_world, truth.back().T_cam_world);
    ASSERT_GT(std::abs(angle_between(drive.front().T_cam_world, drive.back().T_cam_world) / turn - 1), 0.15);
    EXPECT_NEAR(angle_between(pose(0), pose(19)), turn, 0.01 * turn);
    EXPECT_NEAR(moved->keyframes[5].points[0].px.x(), truth[5].points[0].px.x(), 1.0);
  }
}

// Without corners; a map in doubt may be wrong by more than the camera is.
TEST(SelfCalibration, AppliesTheFocalLengthThatMatchesShowUnlessInDoubt) {
  constexpr double kFocal = 0.05;
  for (const bool is_doubtful : {false, true}) {
    SyntheticDrive o;
    o.keyframes = 20;
    std::vector<Keyframe> drive = seen_by_file(kFocal, make_drive(o));
    drive.back().is_doubtful = is_doubtful;
    SelfCalibrationParams params;
    params.refine = "focal";
    SelfCalibration calibration(test::pinhole(), params);
    const auto moved = calibration.estimate(map_of(drive, drive.size()), BaOptions(), false);
    EXPECT_EQ(moved.has_value(), !is_doubtful);
    EXPECT_NEAR(calibration.state().applied.focal, is_doubtful ? 0 : kFocal, 0.01);
  }
}

// Corners that are all wrong, say.
TEST(SelfCalibration, AFocalLengthThatTheMapSpeaksAgainstStaysOut) {
  SyntheticDrive o;
  o.keyframes = 20;
  const std::vector<Keyframe> drive = make_drive(o);
  SelfCalibration calibration(test::pinhole(), {});
  const Map map = map_of(drive, drive.size());
  calibration.note_focal_length({0.25, 0.05, 3});
  ASSERT_TRUE(calibration.is_focal_length_due(map));
  EXPECT_FALSE(calibration.estimate(map, BaOptions(), false));
  EXPECT_EQ(calibration.state().applied.focal, 0);
  EXPECT_EQ(focal_state(calibration.state()), State::kInsignificant);
  EXPECT_FALSE(calibration.is_focal_length_due(map)) << "not the same again";
  calibration.note_focal_length({0.25, 0.05, 4});
  EXPECT_TRUE(calibration.is_focal_length_due(map));
}

// A segment that knows less of k1 than the one before waits for nothing here.
TEST(SelfCalibration, AFocalLengthIsTriedInAShorterSegment) {
  SyntheticDrive first;
  first.k1 = 0.012;
  SelfCalibration calibration(test::pinhole(), {});
  const std::vector<Keyframe> drive = make_drive(first);
  ASSERT_TRUE(calibration.estimate(map_of(drive, drive.size()), BaOptions(), true));
  ASSERT_EQ(k1_state(calibration.state()), State::kApplied);
  const Map shorter = map_of(corrected_by(calibration.state().applied, drive), 20);
  calibration.note_focal_length({0.25, 0.05, 3});
  ASSERT_TRUE(calibration.is_focal_length_due(shorter));
  EXPECT_FALSE(calibration.estimate(shorter, BaOptions(), false)) << "this map speaks against it";
  EXPECT_FALSE(calibration.is_focal_length_due(shorter)) << "it was tried";
}

TEST(SelfCalibration, KeepsTheFocalLengthOfTheFileUnlessRequested) {
  const std::vector<Keyframe> drive = make_drive({});
  const Map map = map_of(drive, 20);
  for (const char* refine : {"none", "k1", "readout"}) {
    SelfCalibrationParams params;
    params.refine = refine;
    SelfCalibration calibration(test::pinhole(), params);
    calibration.note_focal_length({0.25, 0.05, 3});
    EXPECT_FALSE(calibration.is_focal_length_due(map)) << refine;
    EXPECT_EQ(focal_state(calibration.state()), State::kOff);
  }
}

TEST(SelfCalibration, DoesNothingWhenOff) {
  SyntheticDrive o;
  o.k1 = 0.02;
  SelfCalibrationParams params;
  params.refine = "none";
  const Outcome out = calibrate(o, params);
  EXPECT_EQ(k1_state(out.state), State::kOff);
  EXPECT_FALSE(out.moved);
}

}  // namespace
}  // namespace edgevo
