// SPDX-License-Identifier: BSD-3-Clause
// Self-calibration on trajectories with exact truth: matches as a lens with a known residual distortion
// yields them.
#include "edgevo/self_calibration/self_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/map/corrected_pixel.h"
#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

struct SyntheticDrive {
  int keyframes = 60;
  /// Residual distortion of the images, unknown to the camera file.
  double k1 = 0;
  /// Read-out time of a rolling shutter, seconds.
  double readout_s = 0;
  double noise_px = 0.15;
  /// Metres per keyframe; 0: a standstill.
  double step = 1.0;
  uint64_t seed = 1;
};

// A path with gentle turns through points on both sides. Points are hosted by keyframes and matched, along
// random normals, in the keyframes around. Estimates are where a window would leave them: near the truth.
std::vector<Keyframe> make_drive(const SyntheticDrive& o) {
  const Pinhole camera = test::pinhole();
  Random random(o.seed);
  std::vector<SE3> T_world_cam(o.keyframes);
  for (int i = 1; i < o.keyframes; ++i) {
    Vector6d step = Vector6d::Zero();
    step << 0.02 * random.normal() * o.step, 0.02 * random.normal() * o.step, o.step,
        0.005 * random.normal() * o.step, 0.03 * std::sin(0.2 * i) * o.step, 0.005 * random.normal() * o.step;
    T_world_cam[i] = T_world_cam[i - 1] * SE3::exp(step);
  }
  std::vector<Keyframe> drive(o.keyframes);
  // The camera bobs and turns about its keyframes, five of them per second; everything it sees is as far away
  // as the middle of the points.
  for (Keyframe& k : drive) {
    k.motion.velocity << 0.3 * random.normal(), 0.5 * random.normal(), -5.0, 0.1 * random.normal(),
        0.1 * random.normal(), 0.1 * random.normal();
    k.motion.velocity *= o.step;
    k.motion.idepth.setConstant(0.08);
  }
  const auto seen_at = [&](int keyframe,
                           const Eigen::Vector2d& px) {  // true pixel -> pixel in the file's image
    return correct_pixel(camera, {o.k1, o.readout_s}, {}, drive[size_t(keyframe)].motion, px);
  };
  for (int h = 0; h < o.keyframes; ++h) {
    drive[h].id = 10 + h;
    drive[h].T_cam_world = T_world_cam[h].inverse();
    for (int n = 0; n < 120; ++n) {
      const Eigen::Vector2d px(random.uniform(20, 1220), random.uniform(10, 366));
      const double depth = random.uniform(5, 40);
      MapPoint p;
      p.px = seen_at(h, px);
      p.normal = Eigen::Vector2d::UnitX();
      p.idepth = 1.0 / depth;
      for (int t = std::max(0, h - 2); t < std::min(o.keyframes, h + 9); ++t) {
        const Eigen::Vector3d p_target =
            T_world_cam[t].inverse() * (T_world_cam[h] * Eigen::Vector3d(camera.ray(px) * depth));
        if (t == h || p_target.z() < 1 || !camera.contains(camera.project(p_target), 8)) continue;
        const double angle = random.uniform(0, 2 * M_PI);
        Observation seen;
        seen.keyframe_id = 10 + t;
        seen.match.kind = MatchKind::kEdge;
        seen.match.normal = {std::cos(angle), std::sin(angle)};
        seen.match.px = seen_at(t, camera.project(p_target)) +
                        o.noise_px * Eigen::Vector2d(random.normal(), random.normal());
        seen.match.inv_sigma_normal = 1.0 / 0.3;
        p.observations.push_back(seen);
      }
      if (!p.observations.empty()) drive[h].points.push_back(std::move(p));
    }
  }
  return drive;
}

constexpr size_t kWindow = 12;

// The first `count` keyframes of a trajectory as a map whose last `active` ones are the window.
Map map_of(const std::vector<Keyframe>& drive, size_t count, size_t active = kWindow) {
  Map map(test::pinhole(), std::make_shared<MapLog>());
  for (size_t i = 0; i < count; ++i) map.add(drive[i]);
  while (map.active().size() > active) map.marginalise_oldest({});
  return map;
}

// The move of a trajectory, as the map applies it.
struct Outcome {
  CameraRefinement state;
  std::optional<MapMoved> moved;
  std::vector<Keyframe> drive;
};

Outcome calibrate(const SyntheticDrive& o, const SelfCalibrationParams& params = {}) {
  Outcome out;
  out.drive = make_drive(o);
  SelfCalibration calibration(test::pinhole(), params);
  Map map = map_of(out.drive, out.drive.size());
  out.moved = calibration.estimate(map, BaOptions(), true);
  if (out.moved) out.moved = map.move(*out.moved, [](const Keyframe& k) { return k.pyramid; });
  out.state = calibration.state();
  return out;
}

TEST(SelfCalibration, FindsTheDistortion) {
  for (const double k1 : {0.01, -0.008, 0.02})
    for (const uint64_t seed : {1, 2, 3}) {
      SyntheticDrive o;
      o.k1 = k1, o.seed = seed;
      const Outcome out = calibrate(o);
      EXPECT_EQ(out.state.state, CameraRefinement::State::kApplied);
      EXPECT_NEAR(out.state.correction.k1, k1, 0.001);
      ASSERT_TRUE(out.moved);
      EXPECT_EQ(out.moved->lens->now.k1, out.state.correction.k1);
      EXPECT_EQ(out.state.shutter.state, CameraRefinement::State::kInsignificant);
      EXPECT_EQ(out.state.correction.readout_s, 0);
    }
}

TEST(SelfCalibration, FindsARollingShutter) {
  for (const double readout_s : {0.02, -0.015, 0.03})
    for (const double k1 : {0.0, 0.012}) {
      SyntheticDrive o;
      o.k1 = k1, o.readout_s = readout_s;
      const Outcome out = calibrate(o);
      EXPECT_EQ(out.state.shutter.state, CameraRefinement::State::kApplied) << readout_s << " " << k1;
      EXPECT_NEAR(out.state.shutter.estimate, readout_s, 0.001);
      EXPECT_NEAR(out.state.correction.readout_s, 1.3 * readout_s, 0.0013)
          << "applied with over-relaxation: distorted rows bias the estimates";
      EXPECT_EQ(out.state.state,
                k1 == 0 ? CameraRefinement::State::kInsignificant : CameraRefinement::State::kApplied);
      EXPECT_NEAR(out.state.estimate, k1, 0.002);
      ASSERT_TRUE(out.moved);
      EXPECT_EQ(out.moved->lens->now, out.state.correction);
    }
}

TEST(SelfCalibration, WithoutOverRelaxationTheEstimateIsApplied) {
  SyntheticDrive o;
  o.readout_s = 0.02;
  SelfCalibrationParams params;
  params.over_relax_readout = false;
  EXPECT_NEAR(calibrate(o, params).state.correction.readout_s, 0.02, 0.001);
}

// With few keyframes, long before k1 is estimated.
TEST(SelfCalibration, ARollingShutterShowsEarly) {
  SyntheticDrive o;
  o.keyframes = 14;
  o.readout_s = 0.02;
  const Outcome out = calibrate(o);
  EXPECT_EQ(out.state.shutter.state, CameraRefinement::State::kApplied);
  EXPECT_NEAR(out.state.shutter.estimate, 0.02, 0.002);
  EXPECT_EQ(out.state.state, CameraRefinement::State::kTooEarly);
  EXPECT_EQ(out.state.correction.k1, 0);
}

TEST(SelfCalibration, EstimatesOnlyWhatIsRequested) {
  SyntheticDrive o;
  o.k1 = 0.012, o.readout_s = 0.02;
  SelfCalibrationParams params;
  params.refine = "k1";
  const CameraRefinement lens = calibrate(o, params).state;
  EXPECT_EQ(lens.shutter.state, CameraRefinement::State::kOff);
  EXPECT_EQ(lens.correction.readout_s, 0);
  params.refine = "readout";
  const CameraRefinement shutter = calibrate(o, params).state;
  EXPECT_EQ(shutter.state, CameraRefinement::State::kOff);
  EXPECT_EQ(shutter.correction.k1, 0);
  EXPECT_EQ(shutter.shutter.state, CameraRefinement::State::kApplied);
  params.refine = "none";
  params.readout_s = 0.02;  // known: used as it is
  EXPECT_EQ(calibrate(o, params).state.correction, (ImageCorrection{0, 0.02}));
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
  const ImageCorrection mistake = calibration.state().correction;
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
  EXPECT_EQ(calibration.state().shutter.state, CameraRefinement::State::kInsignificant);
  EXPECT_EQ(calibration.state().correction.readout_s, 0);
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
  const ImageCorrection mistake = calibration.state().correction;
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
  EXPECT_NEAR(calibration.state().shutter.estimate, 0.02, 0.001);
}

TEST(SelfCalibration, LeavesAGoodCameraAlone) {
  for (const uint64_t seed : {1, 2, 3, 4}) {
    SyntheticDrive o;
    o.seed = seed;
    const Outcome out = calibrate(o);
    EXPECT_EQ(out.state.state, CameraRefinement::State::kInsignificant);
    EXPECT_LT(std::abs(out.state.estimate), 0.001);
    EXPECT_EQ(out.state.correction.k1, 0);
    EXPECT_FALSE(out.moved);
  }
}

TEST(SelfCalibration, ReportsWhenNothingIsObservable) {
  SyntheticDrive still;
  still.step = 0.002;
  still.k1 = 0.01;
  const Outcome out = calibrate(still);
  EXPECT_EQ(out.state.state, CameraRefinement::State::kNotObservable);
  EXPECT_FALSE(out.moved);

  SyntheticDrive brief;
  brief.keyframes = 20;
  brief.k1 = 0.01;
  EXPECT_EQ(calibrate(brief).state.state, CameraRefinement::State::kTooEarly);
}

TEST(SelfCalibration, DoesNothingWhenOff) {
  SyntheticDrive o;
  o.k1 = 0.02;
  SelfCalibrationParams params;
  params.refine = "none";
  const Outcome out = calibrate(o, params);
  EXPECT_EQ(out.state.state, CameraRefinement::State::kOff);
  EXPECT_FALSE(out.moved);
}

TEST(SelfCalibration, TheNewestKeyframeKeepsItsPose) {
  SyntheticDrive o;
  o.k1 = 0.015;
  const Outcome out = calibrate(o);
  ASSERT_TRUE(out.moved);
  const KeyframeMove& newest = out.moved->keyframes.back();
  EXPECT_LT((out.moved->T_cam_map(newest) * out.drive.back().T_cam_world.inverse()).log().norm(), 1e-12);
  EXPECT_NEAR(newest.length_ratio, 1.0, 0.05);
  ASSERT_EQ(out.moved->keyframes.size(), out.drive.size());
  for (size_t i = 0; i < out.drive.size(); ++i) {
    EXPECT_EQ(out.moved->keyframes[i].id, out.drive[i].id);
    EXPECT_EQ(out.moved->keyframes[i].points.size(), out.drive[i].points.size());
  }
}

// The trajectory is the truth: after a correction the shape of the path is the true one again.
void expect_true_shape(const MapMoved& moved, const std::vector<Keyframe>& drive) {
  ASSERT_EQ(moved.keyframes.size(), drive.size());
  const auto step = [](const SE3& a, const SE3& b) { return (b * a.inverse()).translation().norm(); };
  const auto ratio = [&](size_t i) {
    return step(moved.T_cam_map(moved.keyframes[i - 1]), moved.T_cam_map(moved.keyframes[i])) /
           step(drive[i - 1].T_cam_world, drive[i].T_cam_world);
  };
  for (size_t i = 1; i < drive.size(); ++i) EXPECT_NEAR(ratio(i) / ratio(drive.size() - 1), 1.0, 0.02) << i;
}

TEST(SelfCalibration, TheMovedTrajectoryHasTheTrueShape) {
  SyntheticDrive o;
  o.k1 = 0.015;
  const Outcome out = calibrate(o);
  ASSERT_TRUE(out.moved);
  expect_true_shape(*out.moved, out.drive);
}

// In a thread of its own: keyframes are added and points removed while the estimate runs.
TEST(SelfCalibration, ChangesDuringAnEstimateAreCarriedOver) {
  SyntheticDrive o;
  o.k1 = 0.015;
  const std::vector<Keyframe> drive = make_drive(o);
  constexpr size_t kKnown = 45;
  SelfCalibration concurrent(test::pinhole(), {}), at_once(test::pinhole(), {});
  ASSERT_TRUE(at_once.estimate(map_of(drive, kKnown), BaOptions(), true));

  concurrent.begin(map_of(drive, kKnown), BaOptions());  // it works on a copy of its own
  EXPECT_TRUE(concurrent.is_running());
  EXPECT_FALSE(concurrent.is_due(map_of(drive, kKnown))) << "one at a time";
  std::vector<Keyframe> now = drive;
  now[kKnown - 1].points.erase(now[kKnown - 1].points.begin(), now[kKnown - 1].points.begin() + 20);
  Map map = map_of(now, now.size());
  std::optional<MapMoved> moved = concurrent.estimate(map, BaOptions(), false);
  EXPECT_FALSE(concurrent.is_running());
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->lens->now, at_once.state().correction) << "the same estimate";
  EXPECT_EQ(concurrent.state().keyframes, int(kKnown));
  moved = map.move(*moved, [](const Keyframe& k) { return k.pyramid; });
  expect_true_shape(*moved, now);
  const KeyframeMove& newest = moved->keyframes.back();
  EXPECT_LT((moved->T_cam_map(newest) * now.back().T_cam_world.inverse()).log().norm(), 1e-12);
  ASSERT_EQ(moved->keyframes[kKnown - 1].points.size(), now[kKnown - 1].points.size());
  // Depths, too: new and old points alike have the true depth in the unit of the newest keyframe.
  for (const size_t k : {kKnown - 1, kKnown + 4})
    for (size_t i = 0; i < now[k].points.size(); ++i)
      EXPECT_NEAR(
          moved->keyframes[k].points[i].idepth * moved->keyframes[k].length_ratio / now[k].points[i].idepth,
          1.0, 0.25)
          << k;
}

// Another producer has moved the map while the estimate ran: applied, it would move keyframes back.
TEST(SelfCalibration, AnEstimateOfAMapThatHasMovedIsDropped) {
  SyntheticDrive o;
  o.k1 = 0.015;
  const std::vector<Keyframe> drive = make_drive(o);
  SelfCalibration calibration(test::pinhole(), {});
  Map map = map_of(drive, drive.size());
  calibration.begin(map, BaOptions());
  MapMoved past;
  past.segment = map.segment();
  past.keyframes.emplace_back();
  past.keyframes.back().id = drive.front().id;
  map.move(past, {});
  EXPECT_FALSE(calibration.estimate(map, BaOptions(), false));
  EXPECT_EQ(calibration.state().correction.k1, 0);
  EXPECT_TRUE(calibration.is_due(map)) << "it begins again";
}

TEST(SelfCalibration, AnUnusedEstimateDoesNoHarm) {
  SyntheticDrive o;
  o.keyframes = 30;
  const std::vector<Keyframe> drive = make_drive(o);
  SelfCalibration calibration(test::pinhole(), {});
  calibration.begin(map_of(drive, 30), BaOptions());
  calibration.cancel();
  EXPECT_FALSE(calibration.is_running());
  EXPECT_EQ(calibration.state().state, CameraRefinement::State::kTooEarly);
  calibration.begin(map_of(drive, 30), BaOptions());  // and is destroyed
}

// A window adjusted with the move's prior stays where the whole adjustment put it.
TEST(SelfCalibration, ThePriorAgreesWithTheWholeAdjustment) {
  SyntheticDrive o;
  o.k1 = 0.01;
  const Outcome out = calibrate(o);
  ASSERT_TRUE(out.moved);
  const MapMoved& r = *out.moved;
  BaProblem window;
  window.pinhole = test::pinhole();
  window.prior = r.prior;
  const int first = int(out.drive.size()) - 12;
  for (size_t i = first; i < out.drive.size(); ++i) {
    window.poses.push_back({r.T_cam_map(r.keyframes[i]), false});
    window.pose_ids.push_back(r.keyframes[i].id);
  }
  for (size_t h = first; h < out.drive.size(); ++h)
    for (size_t n = 0; n < out.drive[h].points.size(); ++n) {
      const MapPoint& p = out.drive[h].points[n];
      const int index = int(window.points.size());
      for (const Observation& seen : p.observations) {
        const int target = seen.keyframe_id - 10 - first;
        if (target < 0) continue;
        window.observations.push_back(
            {index, target, correct_pixel(window.pinhole, {}, r.lens->now, {}, seen.match.px),
             correct_normal(window.pinhole, {}, r.lens->now, {}, seen.match.px, seen.match.normal),
             seen.match.inv_sigma_normal, 0.0});
      }
      if (!window.observations.empty() && window.observations.back().point == index)
        window.points.push_back({int(h) - first, window.pinhole.ray(r.keyframes[h].points[n].px),
                                 r.keyframes[h].points[n].idepth, false});
    }
  const BaProblem before = window;
  const BaResult result = make_bundle_adjuster("schur")->solve(&window, BaOptions());
  ASSERT_TRUE(result.usable);
  EXPECT_LT(test::pose_difference(before, window), 0.01);  // of steps of one metre
}

TEST(SelfCalibration, NeedsNoMatchesAfterTheLastCheckpoint) {
  SelfCalibrationParams params;
  params.refine = "k1";
  params.min_keyframes = 15;  // checkpoints at 15, 30 and 60
  SyntheticDrive o;
  o.keyframes = 72;
  const std::vector<Keyframe> drive = make_drive(o);
  SelfCalibration calibration(test::pinhole(), params);
  int estimates = 0;
  for (size_t count = kWindow + 1; count <= drive.size(); ++count) {
    const Map map = map_of(drive, count);
    EXPECT_EQ(calibration.needs_matches(), estimates < 3);
    if (!calibration.is_due(map)) continue;
    ++estimates;
    calibration.estimate(map, BaOptions(), false);
  }
  EXPECT_EQ(estimates, 3);
  EXPECT_EQ(calibration.state().keyframes, 60);
}

TEST(SelfCalibration, AShorterSegmentDoesNotOverruleALongerOne) {
  SyntheticDrive o;
  o.k1 = 0.015;
  const std::vector<Keyframe> drive = make_drive(o);
  SelfCalibration calibration(test::pinhole(), {});
  ASSERT_TRUE(calibration.estimate(map_of(drive, 60), BaOptions(), true));
  const CameraRefinement found = calibration.state();
  calibration.cancel();
  EXPECT_FALSE(calibration.estimate(map_of(drive, 35), BaOptions(), true));
  EXPECT_EQ(calibration.state().correction.k1, found.correction.k1);
  EXPECT_EQ(calibration.state().keyframes, found.keyframes);
}

}  // namespace
}  // namespace edgevo
