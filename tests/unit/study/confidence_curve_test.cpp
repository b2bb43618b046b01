// SPDX-License-Identifier: BSD-3-Clause
// Hand-made rankings with known curves and areas.
#include "edgevo/study/confidence_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

std::vector<RankedMatch> ranking(const std::vector<bool>& right_by_falling_confidence) {
  std::vector<RankedMatch> matches;
  for (const bool right : right_by_falling_confidence)
    matches.push_back({1.0 / double(matches.size() + 1), right});
  return matches;
}

TEST(ConfidenceCurve, APerfectRanking) {
  const ConfidenceCurve c = rank_by_confidence(ranking({true, true, true, false}));
  EXPECT_DOUBLE_EQ(c.error_rate, 0.25);
  EXPECT_DOUBLE_EQ(c.roc_area, 1);
  EXPECT_DOUBLE_EQ(c.precision_recall_area, 1);
  ASSERT_EQ(c.points.size(), 4u);
  EXPECT_DOUBLE_EQ(c.points[2].recall, 1);
  EXPECT_DOUBLE_EQ(c.points[2].error_rate, 0);
  EXPECT_DOUBLE_EQ(c.points[3].precision, 0.75);
}

TEST(ConfidenceCurve, TheWorstRanking) {
  const ConfidenceCurve c = rank_by_confidence(ranking({false, true, true}));
  EXPECT_DOUBLE_EQ(c.roc_area, 0);
  EXPECT_DOUBLE_EQ(c.points[0].error_rate, 1);
  EXPECT_NEAR(c.points[1].error_rate, 0.5, 1e-12);
}

TEST(ConfidenceCurve, AMixedRankingCountsPairs) {
  // Right above wrong in 3 of 4 pairs: (1,2) (1,4) (3,4), not (3,2).
  EXPECT_DOUBLE_EQ(rank_by_confidence(ranking({true, false, true, false})).roc_area, 0.75);
}

TEST(ConfidenceCurve, EqualConfidencesAreUninformative) {
  const ConfidenceCurve c = rank_by_confidence({{0.5, true}, {0.5, false}, {0.5, true}, {0.5, false}});
  EXPECT_DOUBLE_EQ(c.roc_area, 0.5);
  EXPECT_EQ(c.points.size(), 1u);
  EXPECT_DOUBLE_EQ(c.sparsification_area, 0.5) << "of a ranking by chance: the error rate";
}

TEST(ConfidenceCurve, OrderOfEqualOnesDoesNotMatter) {
  const ConfidenceCurve a = rank_by_confidence({{0.9, true}, {0.5, true}, {0.5, false}});
  const ConfidenceCurve b = rank_by_confidence({{0.5, false}, {0.9, true}, {0.5, true}});
  EXPECT_DOUBLE_EQ(a.roc_area, b.roc_area);
  EXPECT_DOUBLE_EQ(a.sparsification_area, b.sparsification_area);
}

TEST(ConfidenceCurve, AreasOfManyMatches) {
  Random random(1);
  std::vector<RankedMatch> perfect, chance;
  for (int i = 0; i < 20000; ++i) {
    const bool right = random.uniform() < 0.7;
    perfect.push_back({(right ? 1 : 0) + random.uniform() * 0.5, right});
    chance.push_back({random.uniform(), right});
  }
  const ConfidenceCurve p = rank_by_confidence(perfect), c = rank_by_confidence(chance);
  EXPECT_NEAR(p.optimal_area, 0.3 + 0.7 * std::log(0.7), 0.01);
  EXPECT_NEAR(p.sparsification_area, p.optimal_area, 0.002);
  EXPECT_NEAR(c.sparsification_area, 0.3, 0.02);
  EXPECT_NEAR(c.roc_area, 0.5, 0.02);
}

TEST(ConfidenceCurve, NothingAndOnlyOneKind) {
  EXPECT_TRUE(rank_by_confidence({}).points.empty());
  EXPECT_DOUBLE_EQ(rank_by_confidence({{1, true}}).roc_area, 0.5);
  const ConfidenceCurve wrong = rank_by_confidence({{1, false}, {0.5, false}});
  EXPECT_DOUBLE_EQ(wrong.optimal_area, 1);
  EXPECT_DOUBLE_EQ(wrong.error_rate, 1);
}

}  // namespace
}  // namespace edgevo
