// SPDX-License-Identifier: BSD-3-Clause
// Each matching method on two views of a plane, against the exact correspondences.
#include "pair_matcher.h"

#include <gtest/gtest.h>

#include "edgevo/study/match_error.h"
#include "epipolar_flow.h"
#include "plane_pair.h"

namespace edgevo {
namespace {

ErrorSummary photometric_errors(const test::PlanePair& pair, const std::vector<Match>& matches) {
  std::vector<MatchError> some;
  for (const MatchError& e : match_errors(pair.host, pair.target, matches))
    if (e.kind == MatchKind::kPhotometric) some.push_back(e);
  return summarise(some);
}

TEST(PairMatcher, AssociationFindsThePoints) {
  const test::PlanePair pair(300, 0.03);
  ASSERT_FALSE(pair.target.is_lost);
  const auto matcher = association_matcher({}, gradient_comparison());
  EXPECT_TRUE(matcher->needs_front_end());
  const auto matches = matcher->match(pair.host, pair.target);
  ASSERT_EQ(matches.size(), pair.host.points.size());
  const ErrorSummary s = photometric_errors(pair, matches);
  EXPECT_GT(s.count, 100);
  EXPECT_LT(s.median_px, 0.5);
  EXPECT_LT(s.wrong_share, 0.1);
}

TEST(PairMatcher, UpdateSearchesAgainForOutliers) {
  const test::PlanePair pair(300, 0.03);
  const auto matcher = association_matcher({}, gradient_comparison());
  auto matches = matcher->match(pair.host, pair.target);
  size_t moved = 0;
  while (matches[moved].kind != MatchKind::kPhotometric) ++moved;
  const Eigen::Vector2d right = matches[moved].px;
  matches[moved].px += 20 * matches[moved].normal;
  const TwoViewSolution s = solve_two_view(pair.camera(), pair.host.points, matches, pair.target.T_start);
  matcher->update(pair.host, pair.target, s, &matches);
  EXPECT_TRUE(matches[moved].kind == MatchKind::kNone || (matches[moved].px - right).norm() < 5);
}

TEST(PairMatcher, LucasKanadeFindsThePoints) {
  const test::PlanePair pair(300, 0.03);
  const auto matcher = lucas_kanade_matcher();
  EXPECT_FALSE(matcher->needs_front_end());
  const ErrorSummary s = photometric_errors(pair, matcher->match(pair.host, pair.target));
  EXPECT_GT(s.count, 200);
  EXPECT_LT(s.median_px, 0.3);
}

TEST(PairMatcher, FlowThatDoesNotFitIsDropped) {
  const test::PlanePair pair(300, 0.03);
  const auto matcher = lucas_kanade_matcher();
  auto matches = matcher->match(pair.host, pair.target);
  ASSERT_EQ(matches[5].kind, MatchKind::kPhotometric);
  matches[5].px += Eigen::Vector2d(0, 15);
  const TwoViewSolution s = solve_two_view(pair.camera(), pair.host.points, matches, pair.target.T_start);
  matcher->update(pair.host, pair.target, s, &matches);
  EXPECT_EQ(matches[5].kind, MatchKind::kNone);
  EXPECT_EQ(matches[6].kind, MatchKind::kPhotometric);
}

std::vector<Eigen::Vector2d> positions(const test::PlanePair& pair) {
  std::vector<Eigen::Vector2d> px;
  for (const StudyPoint& p : pair.host.points) px.push_back(p.px);
  return px;
}

class EpipolarFlow : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(EpipolarFlow, FindsThePointsWhateverTheLight) {
  const auto [gain, offset] = GetParam();
  const test::PlanePair pair(300, 0.03, gain, offset);
  const auto flow = epipolar_flow(*pair.host.pyramid, *pair.target.pyramid, positions(pair));
  std::vector<double> errors;
  for (size_t i = 0; i < flow.size(); ++i)
    if (flow[i].found && pair.target.truth[i].visible)
      errors.push_back((flow[i].px - pair.target.truth[i].px).norm());
  ASSERT_GT(errors.size(), 200u);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.5);
  EXPECT_LT(errors[errors.size() * 9 / 10], 2);
}
INSTANTIATE_TEST_SUITE_P(Lights, EpipolarFlow,
                         ::testing::Values(std::pair(1.0, 0.0), std::pair(0.6, 40.0), std::pair(0.8, -10.0)));

TEST(EpipolarFlowOfNothing, FindsNothing) {
  const test::PlanePair pair;
  EXPECT_TRUE(epipolar_flow(*pair.host.pyramid, *pair.target.pyramid, {}).empty());
  PyramidBuilder builder(pair.scene.camera, EdgeParams());
  const auto blank = builder.build(test::make_image(320, 240, [](double, double) { return 90.0; }));
  for (const FlowMatch& m : epipolar_flow(*blank, *blank, {{100, 100}, {50, 60}})) EXPECT_FALSE(m.found);
  for (const FlowMatch& m : epipolar_flow(*pair.host.pyramid, *blank, positions(pair))) EXPECT_FALSE(m.found);
  // A point at the border or outside is not found and has no effect.
  EXPECT_FALSE(epipolar_flow(*pair.host.pyramid, *pair.target.pyramid, {{-5, 3}})[0].found);
}

TEST(MatchError, AlongTheAxesOfTheEdge) {
  const test::PlanePair pair(50, 0.01);
  std::vector<Match> matches(pair.host.points.size());
  size_t i = 0;
  while (!pair.target.truth[i].visible) ++i;
  matches[i].kind = MatchKind::kPhotometric;
  matches[i].normal = Eigen::Vector2d(0.6, 0.8);
  matches[i].px = pair.target.truth[i].px + 2 * matches[i].normal + 1 * Eigen::Vector2d(-0.8, 0.6);
  const auto errors = match_errors(pair.host, pair.target, matches);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NEAR(errors[0].normal_px, 2, 1e-9);
  EXPECT_NEAR(errors[0].tangent_px, 1, 1e-9);
  EXPECT_NEAR(errors[0].norm(), std::sqrt(5.0), 1e-9);
}

TEST(MatchError, HiddenPointsAreSkipped) {
  test::PlanePair pair(50, 0.01);
  std::vector<Match> matches(pair.host.points.size());
  matches[0].kind = MatchKind::kPhotometric;
  matches[0].px = matches[0].normal = Eigen::Vector2d(1, 0);
  pair.target.truth[0].visible = false;
  EXPECT_TRUE(match_errors(pair.host, pair.target, matches).empty());
}

TEST(MatchError, DepthOfAnEdgeMatch) {
  const test::PlanePair pair(100, 0.01);
  const Pinhole& camera = pair.camera();
  for (size_t i = 0; i < pair.host.points.size(); ++i) {
    const StudyPoint& p = pair.host.points[i];
    Match m;
    m.px = camera.project(pair.target.T_target_host * (camera.ray(p.px) / p.idepth_true));
    m.normal = (m.px - p.px).normalized();
    EXPECT_NEAR(idepth_from_edge(camera, pair.target.T_target_host, p.px, m), p.idepth_true, 1e-6);
  }
  Match m;
  m.px = m.normal = Eigen::Vector2d(1, 0);
  EXPECT_TRUE(std::isnan(idepth_from_edge(camera, SE3(), {10, 10}, m))) << "no motion, no depth";
}

TEST(MatchError, Summary) {
  std::vector<MatchError> errors(4);
  errors[0].normal_px = 0.1, errors[1].normal_px = -0.3, errors[2].tangent_px = 1, errors[3].tangent_px = -6;
  const ErrorSummary s = summarise(errors);
  EXPECT_EQ(s.count, 4);
  EXPECT_DOUBLE_EQ(s.mean_px, (0.1 + 0.3 + 1 + 6) / 4);
  EXPECT_DOUBLE_EQ(s.wrong_share, 0.25);
  EXPECT_DOUBLE_EQ(s.median_px, 1) << "the upper one of two";
  EXPECT_EQ(summarise({}).count, 0);
}

}  // namespace
}  // namespace edgevo
