// SPDX-License-Identifier: BSD-3-Clause
// What self-calibration does to the map: poses and points after a correction, changes while the estimate
// runs, keyframes that are only a prior.
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

TEST(SelfCalibration, TheNewestKeyframeKeepsItsPose) {
  SyntheticDrive o;
  o.k1 = 0.015;
  const Outcome out = calibrate(o);
  ASSERT_TRUE(out.moved);
  const KeyframeMove& newest = out.moved->keyframes.back();
  EXPECT_LT((out.moved->T_cam_map(newest) * out.drive.back().T_cam_world.inverse()).log().norm(), 1e-12);
  EXPECT_NEAR(newest.scale_ratio, 1.0, 0.05);
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
  EXPECT_EQ(moved->lens->now, at_once.state().applied) << "the same estimate";
  EXPECT_EQ(concurrent.state().given.keyframes, int(kKnown));
  moved = map.move(*moved, [](const Keyframe& k) { return k.pyramid; });
  expect_true_shape(*moved, now);
  const KeyframeMove& newest = moved->keyframes.back();
  EXPECT_LT((moved->T_cam_map(newest) * now.back().T_cam_world.inverse()).log().norm(), 1e-12);
  ASSERT_EQ(moved->keyframes[kKnown - 1].points.size(), now[kKnown - 1].points.size());
  // Depths, too: new and old points alike have the true depth in the unit of the newest keyframe.
  for (const size_t k : {kKnown - 1, kKnown + 4})
    for (size_t i = 0; i < now[k].points.size(); ++i)
      EXPECT_NEAR(
          moved->keyframes[k].points[i].idepth * moved->keyframes[k].scale_ratio / now[k].points[i].idepth,
          1.0, 0.25)
          << k;
}

// A map in doubt waits for no other estimate, but for this one.
TEST(SelfCalibration, AFocalLengthIsDueWhileItIsEstimated) {
  const std::vector<Keyframe> drive = make_drive({});
  SelfCalibration calibration(test::pinhole(), {});
  const Map map = map_of(drive, 20);
  calibration.begin(map, BaOptions());
  calibration.note_focal_length({0.25, 0.05, 3});
  EXPECT_FALSE(calibration.is_focal_length_due(map)) << "another estimate is running";
  calibration.cancel();
  calibration.begin(map, BaOptions());
  EXPECT_TRUE(calibration.is_running());
  EXPECT_TRUE(calibration.is_focal_length_due(map));
  EXPECT_FALSE(calibration.is_due(map)) << "one at a time";
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
  EXPECT_EQ(calibration.state().applied.k1, 0);
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
  EXPECT_EQ(calibration.state().state_of(CameraNumber::kK1), CameraPosterior::State::kTooEarly);
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
  params.min_keyframes = 15;  // the last checkpoint is at 60
  SyntheticDrive o;
  o.keyframes = 72;
  const std::vector<Keyframe> drive = make_drive(o);
  SelfCalibration calibration(test::pinhole(), params);
  int estimates = 0;
  for (size_t count = test::kDriveWindow + 1; count <= drive.size(); ++count) {
    const Map map = map_of(drive, count);
    EXPECT_EQ(calibration.needs_matches(), count <= 60);
    if (!calibration.is_due(map)) continue;
    ++estimates;
    calibration.estimate(map, BaOptions(), false);
  }
  EXPECT_EQ(estimates, 4) << "a window, and three checkpoints";
  EXPECT_EQ(calibration.state().given.keyframes, 60);
}

TEST(SelfCalibration, AShorterSegmentDoesNotOverruleALongerOne) {
  SyntheticDrive o;
  o.k1 = 0.015;
  const std::vector<Keyframe> drive = make_drive(o);
  SelfCalibration calibration(test::pinhole(), {});
  ASSERT_TRUE(calibration.estimate(map_of(drive, 60), BaOptions(), true));
  const CameraPosterior found = calibration.state();
  calibration.cancel();
  EXPECT_FALSE(calibration.estimate(map_of(drive, 35), BaOptions(), true));
  EXPECT_EQ(calibration.state().applied.k1, found.applied.k1);
  EXPECT_EQ(calibration.state().given.keyframes, found.given.keyframes);
}

}  // namespace
}  // namespace edgevo
