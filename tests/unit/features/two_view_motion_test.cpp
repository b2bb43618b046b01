// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/two_view_motion.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

struct Views {
  Pinhole pinhole{500, 500, 320, 240, 640, 480};
  SE3 truth;
  std::vector<cv::Point2f> first, last;
  std::vector<Eigen::Vector3d> rays_first, rays_last;

  Views(const Eigen::Vector3d& t, const Eigen::Vector3d& w, double noise_px, double nearest = 3,
        double farthest = 12, uint64_t seed = 3) {
    Vector6d xi;
    xi << Eigen::Vector3d::Zero(), w;
    truth = SE3(SE3::exp(xi).rotation(), t);
    Random random(seed);
    while (first.size() < 300) {
      const Eigen::Vector2d px(random.uniform(20, 620), random.uniform(20, 460));
      const Eigen::Vector3d p = truth * (pinhole.ray(px) * random.uniform(nearest, farthest));
      if (p.z() < 0.5 || !pinhole.contains(pinhole.project(p))) continue;
      const Eigen::Vector2d q =
          pinhole.project(p) + noise_px * Eigen::Vector2d(random.normal(), random.normal());
      first.emplace_back(float(px.x()), float(px.y()));
      last.emplace_back(float(q.x()), float(q.y()));
      rays_first.push_back(pinhole.ray(px));
      rays_last.push_back(pinhole.ray(q));
    }
  }
  double rotation_error(const SE3& T) const { return (T * truth.inverse()).angle(); }
  double direction_error(const SE3& T) const { return angle_between(T.translation(), truth.translation()); }
};

// Without noise the steps converge to the truth from a wrong start: with a wrong derivative they could not.
TEST(RefineMotion, RecoversAPerturbedMotionExactly) {
  const Views v({0.5, 0.1, 0.2}, {0.02, -0.05, 0.03}, 0);
  Vector6d xi;
  xi << 0, 0, 0, 0.01, -0.01, 0.015;
  const SE3 start =
      SE3(SE3::exp(xi).rotation() * v.truth.rotation(), Eigen::Vector3d(0.5, 0.2, 0.1).normalized());
  const SE3 T = refine_motion(start, v.rays_first, v.rays_last, 500, 0.5);
  EXPECT_LT(v.rotation_error(T), 1e-7);
  EXPECT_LT(v.direction_error(T), 1e-6);
}

TEST(RefineMotion, SharpensTheMotionOfRansac) {
  const Views v({0.5, 0.1, 0.2}, {0.02, -0.05, 0.03}, 0.3);
  Random random(1);
  const auto motions = estimate_motions(v.pinhole, v.first, v.last, 0.7, 5, &random);
  ASSERT_FALSE(motions.empty());
  for (const TwoViewMotion& m : motions) {
    EXPECT_LT(v.rotation_error(m.T_last_first), 0.004);
    EXPECT_LT(v.direction_error(m.T_last_first), 0.03);
  }
  EXPECT_FALSE(is_ambiguous(motions.front(), motions));
}

// Depths of 36 to 110 times the baseline, as at the beginning of a slow motion: no evidence against them.
TEST(EstimateMotions, FarCornersAgree) {
  const Views v({0.5, 0.1, 0.2}, {0.02, -0.05, 0.03}, 0.2, 20, 60);
  Random random(1);
  const auto motions = estimate_motions(v.pinhole, v.first, v.last, 0.7, 5, &random);
  ASSERT_FALSE(motions.empty());
  for (const TwoViewMotion& m : motions) EXPECT_GT(cv::countNonZero(m.inliers), 285);
}

// RANSAC's samples of five scatter with the noise; refined over all inliers they do not.
TEST(EstimateMotions, AllSamplesEndAtOneMotion) {
  const Views v({0.5, 0.1, 0.2}, {0.02, -0.05, 0.03}, 0.4);
  Random random(1);
  const auto motions = estimate_motions(v.pinhole, v.first, v.last, 0.7, 5, &random);
  ASSERT_GE(motions.size(), 4u);
  for (const TwoViewMotion& m : motions) {
    EXPECT_LT((m.T_last_first * motions.front().T_last_first.inverse()).angle(), 3e-4);
    EXPECT_GT(cv::countNonZero(m.inliers), 200);
  }
}

// A corner that fits the epipolar line from behind a view is an outlier.
TEST(EstimateMotions, ACornerBehindAViewDoesNotAgree) {
  Views v({0.5, 0.1, 0.2}, {0.02, -0.05, 0.03}, 0);
  const size_t good = v.first.size();
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2d px(200 + 6 * i, 240), q = v.pinhole.project(v.truth * (-4 * v.pinhole.ray(px)));
    v.first.emplace_back(float(px.x()), float(px.y()));
    v.last.emplace_back(float(q.x()), float(q.y()));
  }
  Random random(1);
  for (const TwoViewMotion& m : estimate_motions(v.pinhole, v.first, v.last, 0.7, 5, &random)) {
    EXPECT_GT(cv::countNonZero(m.inliers.rowRange(0, int(good))), 295);
    EXPECT_EQ(cv::countNonZero(m.inliers.rowRange(int(good), int(v.first.size()))), 0);
  }
}

// A gyro that is right to a tenth of a degree.
TurnOfViews turn_of(const SE3& T, double off_rad = 0) {
  TurnOfViews turn;
  turn.R_last_first = Eigen::AngleAxisd(off_rad, Eigen::Vector3d::UnitY()) * T.rotation();
  turn.information = Eigen::Matrix3d::Identity() / (0.0017 * 0.0017);
  return turn;
}

// Far corners hardly distinguish a turn from a translation: with a known one only its direction is left.
TEST(MotionWithTurn, TheDirectionIsSharperThanWithoutAndOutliersDoNoHarm) {
  double with = 0, without = 0;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Views v({0.5, 0.1, 0.2}, {0.02, -0.05, 0.03}, 0.3, 25, 40, seed);
    Random random(seed);
    for (size_t i = 0; i < v.last.size(); i += 3) v.last[i].x += float(random.uniform(5, 40));
    const auto m =
        estimate_motion_with_turn(v.pinhole, v.first, v.last, 0.7, turn_of(v.truth, 0.0005), &random);
    ASSERT_TRUE(m) << seed;
    EXPECT_LT(v.rotation_error(m->T_last_first), 0.0025) << seed;
    EXPECT_LT(v.direction_error(m->T_last_first), 0.12) << seed;
    with += v.direction_error(m->T_last_first);
    const auto motions = estimate_motions(v.pinhole, v.first, v.last, 0.7, 5, &random);
    ASSERT_FALSE(motions.empty());
    without += v.direction_error(motions.front().T_last_first);
  }
  EXPECT_LT(with, 0.7 * without);
}

TEST(MotionWithTurn, AnotherRotationContradictsOnlyBeyondThreeSigmas) {
  const SE3 T;
  const TurnOfViews turn = turn_of(T);
  EXPECT_FALSE(turn.contradicts(turn_of(T, 0.004).R_last_first));
  EXPECT_TRUE(turn.contradicts(turn_of(T, 0.006).R_last_first));
}

TEST(IsAmbiguous, MotionsThatFitAlikeButDisagree) {
  TwoViewMotion a, b;
  a.median_error_px = 0.2, b.median_error_px = 0.25;
  a.parallax_rad = b.parallax_rad = 0.02;
  Vector6d xi = Vector6d::Zero();
  xi[4] = 0.01;
  b.T_last_first = SE3::exp(xi);
  EXPECT_TRUE(is_ambiguous(a, {a, b}));
  b.median_error_px = 0.5;  // fits much worse: no rival
  EXPECT_FALSE(is_ambiguous(a, {a, b}));
}

}  // namespace
}  // namespace edgevo
