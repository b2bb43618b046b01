// SPDX-License-Identifier: BSD-3-Clause
#include "two_view_solve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plane_pair.h"

namespace edgevo {
namespace {

// The exact correspondences as 2-D matches.
std::vector<Match> exact_matches(const test::PlanePair& pair) {
  std::vector<Match> matches;
  for (size_t i = 0; i < pair.host.points.size(); ++i) {
    Match m;
    if (pair.target.truth[i].visible) {
      m.kind = MatchKind::kPhotometric;
      m.px = pair.target.truth[i].px;
      m.normal = pair.host.points[i].normal;
      m.inv_sigma_normal = 2, m.inv_sigma_tangent = 1;
    }
    matches.push_back(m);
  }
  return matches;
}

double drift(const TwoViewSolution& s, const SE3& truth) {
  return (s.T_target_host.translation() - truth.translation()).norm() / truth.translation().norm();
}

TEST(TwoViewSolve, ExactMatchesAndDepthsGiveThePose) {
  const test::PlanePair pair(300, 1e-5);
  const TwoViewSolution s = solve_two_view(pair.camera(), pair.host.points, exact_matches(pair), SE3());
  ASSERT_TRUE(s.usable);
  EXPECT_LT(drift(s, pair.target.T_target_host), 1e-3);
}

// Points in a volume: two views of a plane, as PlanePair has, leave pose and depths partly free.
TEST(TwoViewSolve, NoisyDepthsAreEstimatedJointly) {
  const Pinhole camera{700, 700, 620, 180, 1240, 376};
  Vector6d xi;
  xi << 0.3, -0.1, -1.0, 0.01, 0.03, -0.01;
  const SE3 T_target_host = SE3::exp(xi);
  Random random(5);
  std::vector<StudyPoint> points;
  std::vector<Match> matches;
  for (int i = 0; i < 400; ++i) {
    StudyPoint p;
    p.px = {random.uniform(20, 1220), random.uniform(20, 356)};
    p.idepth_true = random.uniform(0.05, 0.3);
    p.idepth_sigma = 0.1 * p.idepth_true;
    p.idepth = p.idepth_true + p.idepth_sigma * random.normal();
    Match m;
    m.kind = MatchKind::kPhotometric;
    m.px = camera.project(T_target_host * (camera.ray(p.px) / p.idepth_true));
    m.normal = Eigen::Vector2d(random.normal(), random.normal()).normalized();
    m.inv_sigma_normal = 2, m.inv_sigma_tangent = 1;
    points.push_back(p);
    matches.push_back(m);
  }
  const TwoViewSolution s = solve_two_view(camera, points, matches, T_target_host);
  ASSERT_TRUE(s.usable);
  // The scale is known to about noise / sqrt(points); beyond it the depths are much better than they were.
  EXPECT_LT(drift(s, T_target_host), 4 * 0.1 / std::sqrt(400.0));
  const double scale = s.T_target_host.translation().norm() / T_target_host.translation().norm();
  double before = 0, after = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    before += std::abs(points[i].idepth / points[i].idepth_true - 1);
    after += std::abs(s.idepth[i] * scale / points[i].idepth_true - 1);
  }
  EXPECT_LT(after, 0.3 * before);
}

TEST(TwoViewSolve, ThePriorIsAGaussianOnTheInverseDepth) {
  // Point-to-tangent matches with normals across the motion do not constrain depth: it keeps its prior.
  const test::PlanePair pair(200, 0.05);
  std::vector<Match> matches = exact_matches(pair);
  for (size_t i = 0; i < matches.size(); ++i) {
    const Eigen::Vector2d motion = pair.target.truth[i].px - pair.host.points[i].px;
    matches[i].normal = Eigen::Vector2d(-motion.y(), motion.x()).normalized();
    matches[i].inv_sigma_tangent = 0;
  }
  const TwoViewSolution s =
      solve_two_view(pair.camera(), pair.host.points, matches, pair.target.T_target_host);
  ASSERT_TRUE(s.usable);
  for (size_t i = 0; i < matches.size(); i += 10)
    EXPECT_NEAR(s.idepth[i], pair.host.points[i].idepth, 0.6 * pair.host.points[i].idepth_sigma) << i;
}

TEST(TwoViewSolve, FixedDepthsStay) {
  const test::PlanePair pair(200, 0.05);
  std::vector<Match> matches = exact_matches(pair);
  for (size_t i = 0; i < matches.size(); i += 2)
    if (matches[i].kind != MatchKind::kNone) matches[i].kind = MatchKind::kEdgeFixed;
  const TwoViewSolution s = solve_two_view(pair.camera(), pair.host.points, matches, pair.target.T_start);
  ASSERT_TRUE(s.usable);
  EXPECT_EQ(s.idepth[0], pair.host.points[0].idepth);
}

TEST(TwoViewSolve, ResidualsBelongToTheirPoints) {
  const test::PlanePair pair(300, 1e-5);
  std::vector<Match> matches = exact_matches(pair);
  ASSERT_EQ(matches[7].kind, MatchKind::kPhotometric);
  matches[7].px += 5 * matches[7].normal;
  const TwoViewSolution s = solve_two_view(pair.camera(), pair.host.points, matches, pair.target.T_start);
  EXPECT_NEAR(s.residual_normal_px[7], -5, 0.3);
  EXPECT_NEAR(s.residual_normal_px[8], 0, 0.2);
}

TEST(TwoViewSolve, TooFewMatchesAreNotUsable) {
  const test::PlanePair pair(300, 0.05);
  std::vector<Match> matches(pair.host.points.size());
  EXPECT_FALSE(solve_two_view(pair.camera(), pair.host.points, matches, SE3()).usable);
  const std::vector<Match> all = exact_matches(pair);
  std::copy_n(all.begin(), 11, matches.begin());
  EXPECT_FALSE(solve_two_view(pair.camera(), pair.host.points, matches, SE3()).usable);
}

}  // namespace
}  // namespace edgevo
