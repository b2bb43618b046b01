// SPDX-License-Identifier: BSD-3-Clause
// Drift, KITTI's figures and the local scale against numbers worked out by hand.
#include "edgevo/evaluation/relative_error.h"

#include <gtest/gtest.h>

#include "support/synthetic_trajectory.h"

namespace edgevo {
namespace {

constexpr double kCap = 30;

// A straight drive whose estimate advances `factor` m a frame where the truth advances 1 m.
TimeMatches straight(int frames, double factor) {
  Trajectory truth = test::straight_drive(frames);
  return match_by_time(test::straight_drive(frames, factor), truth, test::frames_of(truth));
}

void remove_poses(TimeMatches* a, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    a->frames[size_t(i)].has_pose = false;
    a->frames[size_t(i)].match = -1;
  }
}

TEST(Drift, StepsTwoPercentTooLongGiveTwoCentimetresPerMetre) {
  const TimeMatches a = straight(201, 1.02);  // 200 m: intervals of 10, 20, 40, 60 m
  const Drift d = drift(a.frames, a.matches, kCap).value();
  EXPECT_NEAR(d.mean_cm_per_m, 2.0, 1e-9);
  EXPECT_NEAR(d.median_cm_per_m, 2.0, 1e-9);
  EXPECT_NEAR(d.path_m, 200.0, 1e-9);
  EXPECT_EQ(d.intervals, 191 + 181 + 161 + 141);
  EXPECT_EQ(d.capped + d.without_poses, 0);
}

TEST(Drift, IsReportedByIntervalLength) {
  TimeMatches a = straight(201, 1.0);
  for (size_t i = 100; i < a.matches.size(); ++i)  // one jump of a metre in the middle
    a.matches[i].T_est = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(1, 0, 0)) * a.matches[i].T_est;
  const Drift d = drift(a.frames, a.matches, kCap).value();
  ASSERT_EQ(d.by_length.size(), d.lengths_m.size());
  int intervals = 0;
  for (size_t i = 0; i < d.by_length.size(); ++i) {
    EXPECT_NEAR(d.by_length[i].max_cm_per_m, 100 / d.lengths_m[i], 1e-9);
    EXPECT_NEAR(d.by_length[i].mean_cm_per_m, 100.0 / d.by_length[i].intervals, 1e-9)
        << "as many see it as it has metres";
    intervals += d.by_length[i].intervals;
  }
  EXPECT_EQ(intervals, d.intervals);
  EXPECT_EQ(drift(straight(451, 1.01).frames, straight(451, 1.01).matches, kCap)->by_length.back().intervals,
            0)
      << "800 m";
}

TEST(Drift, ASidewaysTurnGivesTheChord) {
  // Estimate turned by phi in its own frame half-way: constant heading error makes no relative error before
  // or after; only intervals across the turn contain it. With all poses turned alike there is none.
  TimeMatches a = straight(101, 1.0);
  const SE3 turn(Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())),
                 Eigen::Vector3d(5, 0, 0));
  for (MatchedPose& m : a.matches) m.T_est = turn * m.T_est;
  EXPECT_LT(drift(a.frames, a.matches, kCap)->mean_cm_per_m, 1e-9);
  // One frame's heading wrong by phi: an interval that begins there is off by the chord 2 L sin(phi/2).
  TimeMatches b = straight(101, 1.0);
  MatchedPose& wrong = b.matches[0];
  wrong.T_est =
      SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY())), wrong.T_est.translation());
  const Drift d = drift(b.frames, b.matches, kCap).value();
  const double chord = 100 * 2 * std::sin(0.05);
  EXPECT_NEAR(d.mean_cm_per_m, 4 * chord / d.intervals, 1e-9);  // four lengths begin at frame 0
}

TEST(Drift, LongPathsUseHundredsOfMetres) {
  const TimeMatches a = straight(451, 1.01);
  const Drift d = drift(a.frames, a.matches, kCap).value();
  EXPECT_EQ(d.lengths_m, (std::vector<double>{100, 200, 300, 400, 500, 600, 700, 800}));
  EXPECT_EQ(d.intervals, 351 + 251 + 151 + 51);
  EXPECT_NEAR(d.mean_cm_per_m, 1.0, 1e-9);
}

TEST(Drift, IsCapped) {
  const TimeMatches a = straight(201, 5.0);
  const Drift d = drift(a.frames, a.matches, kCap).value();
  EXPECT_EQ(d.mean_cm_per_m, kCap);
  EXPECT_EQ(d.capped, d.intervals);
}

TEST(Drift, IntervalsWithoutPosesCountTheCap) {
  TimeMatches a = straight(201, 1.0);
  remove_poses(&a, 100, 201);
  const Drift d = drift(a.frames, a.matches, kCap).value();
  // Brute force: an interval [i, i + L] lacks its end if i + L >= 100; both ends before that are whole.
  int missing = 0;
  for (int length : {10, 20, 40, 60})
    for (int i = 0; i + length <= 200; ++i) missing += i + length >= 100;
  EXPECT_EQ(d.without_poses, missing);
  EXPECT_NEAR(d.mean_cm_per_m, kCap * missing / d.intervals, 1e-9);
}

TEST(Drift, HalfTheFramesWithoutPosesCountTheCapToo) {
  TimeMatches a = straight(41, 1.0);  // 40 m: 2, 4, 8, 12 m
  remove_poses(&a, 20, 26);
  const Drift d = drift(a.frames, a.matches, kCap).value();
  int missing = 0;
  for (int length : {2, 4, 8, 12})
    for (int i = 0; i + length <= 40; ++i) {
      const int j = i + length;
      const auto lacks = [](int k) { return k >= 20 && k < 26; };
      int lacking = 0;
      for (int k = i; k <= j; ++k) lacking += lacks(k);
      missing += lacks(i) || lacks(j) || 2 * lacking >= length + 1;
    }
  EXPECT_EQ(d.without_poses, missing);
}

TEST(Drift, ACameraThatStandsStillHasNone) {
  TimeMatches a = straight(20, 1.0);
  for (EvaluatedFrame& f : a.frames) f.T_gt = SE3();
  EXPECT_FALSE(drift(a.frames, a.matches, kCap));
}

TEST(KittiRelative, ScaleErrorAndYawRate) {
  const TimeMatches a = straight(301, 1.03);
  const KittiRelative k = kitti_relative(a.frames, a.matches, 1.0).value();
  EXPECT_NEAR(k.t_rel_percent, 3.0, 1e-9);
  EXPECT_NEAR(k.r_rel_deg_per_100m, 0.0, 1e-6);
  EXPECT_EQ(k.intervals, 21 + 11 + 1);  // every tenth frame, 100, 200 and 300 m
  EXPECT_NEAR(kitti_relative(a.frames, a.matches, 1 / 1.03)->t_rel_percent, 0.0, 1e-9);
  EXPECT_FALSE(kitti_relative(straight(90, 1.0).frames, straight(90, 1.0).matches, 1.0));
}

TEST(KittiRelative, RotationIsInDegreesPerHundredMetres) {
  TimeMatches a = straight(201, 1.0);
  for (size_t i = 0; i < a.matches.size(); ++i) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.002 * double(i) * M_PI / 180, Eigen::Vector3d::UnitX()));
    a.matches[i].T_est = SE3(q, a.matches[i].T_est.translation());
  }
  EXPECT_NEAR(kitti_relative(a.frames, a.matches, 1.0)->r_rel_deg_per_100m, 0.2, 1e-6);
}

TEST(ScaleCurve, ShowsAUnitThatGrows) {
  const Trajectory truth = test::straight_drive(300);
  Trajectory est = truth;
  double z = 0;
  for (int i = 1; i < 300; ++i) {
    z += 1.0 + (i > 150 ? 0.2 : 0.0);
    est.poses[size_t(i)].T_world_cam = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, z));
  }
  const TimeMatches a = match_by_time(est, truth, test::frames_of(truth));
  const std::vector<ScalePoint> curve = scale_curve(a.matches, 50, 1.0);
  ASSERT_EQ(curve.size(), 11u);
  EXPECT_NEAR(curve.front().relative_scale, 1.0, 1e-9);
  EXPECT_NEAR(curve.back().relative_scale, 1.2, 1e-9);
  EXPECT_EQ(curve.back().first_frame, 250);
  EXPECT_EQ(curve.back().last_frame, 299);
}

}  // namespace
}  // namespace edgevo
