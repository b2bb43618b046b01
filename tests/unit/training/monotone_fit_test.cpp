// SPDX-License-Identifier: BSD-3-Clause
// The fit of the trust: it finds weights that made the data, gives none to a doubt that would support a
// motion, is calibrated, and bounds false alarms on values it has not seen.
#include "monotone_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/random.h"

namespace edgevo::training {
namespace {

// Motions whose log odds of being wrong are -2 + 2 d0 + 1 d1 - 1 d2; the other doubts are noise.
std::vector<EvaluatedMotion> made_motions(uint64_t seed, int count) {
  Random random(seed);
  std::vector<EvaluatedMotion> motions;
  for (int i = 0; i < count; ++i) {
    EvaluatedMotion m;
    for (double& d : m.doubts) d = 3 * random.uniform() * random.uniform();
    const double odds = -2 + 2 * m.doubts[0] + m.doubts[1] - m.doubts[2];
    m.is_wrong = random.uniform() < 1 / (1 + std::exp(-odds));
    motions.push_back(m);
  }
  return motions;
}

TEST(LogisticFit, FindsTheWeightsAndGivesNoneToATestThatFavoursTheMotion) {
  const LogisticSum fit = fit_logistic(made_motions(1, 20000), 1);
  EXPECT_NEAR(fit.weights[0], 2, 0.2);
  EXPECT_NEAR(fit.weights[1], 1, 0.2);
  EXPECT_EQ(fit.weights[2], 0);
  for (size_t k = 3; k < kConsistencyTests; ++k) EXPECT_LT(fit.weights[k], 0.12);
}

TEST(LogisticFit, IsNotBentByWrongMotionsThatNoDoubtShows) {
  std::vector<EvaluatedMotion> motions = made_motions(1, 20000);
  for (size_t i = 0; i < motions.size(); i += 5) motions[i].is_wrong = true;
  const LogisticSum bent = fit_logistic(motions, 1), kept = fit_logistic(motions, 1, 0.2);
  EXPECT_LT(bent.weights[0], 1.6);
  EXPECT_NEAR(kept.weights[0], 2, 0.25);
  EXPECT_NEAR(kept.weights[1], 1, 0.2);
}

TEST(LogisticFit, IsTheSameForTheSameMotions) {
  EXPECT_EQ(fit_logistic(made_motions(2, 500), 1).weights, fit_logistic(made_motions(2, 500), 1).weights);
}

TEST(LogisticFit, StaysFiniteForSeparableMotions) {
  std::vector<EvaluatedMotion> motions(40);
  for (size_t i = 0; i < 20; ++i) motions[i].is_wrong = true, motions[i].doubts[0] = 1;
  const LogisticSum fit = fit_logistic(motions, 1);
  EXPECT_TRUE(std::isfinite(fit.weights[0]));
  EXPECT_GT(fit.weights[0], 1);
}

TEST(LogisticFit, IsTrueOnOtherMotions) {
  const std::vector<EvaluatedMotion> train = made_motions(1, 20000), test = made_motions(2, 20000);
  const LogisticSum fit = fit_logistic(train, 1);
  double expected = 0, right = 0, count = 0;
  for (const EvaluatedMotion& m : test) {
    const double p = fit.p_right(m.doubts);
    if (p < 0.6 || p > 0.8) continue;
    expected += p, right += !m.is_wrong, ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_NEAR(expected / count, right / count, 0.05);
}

TEST(Conformal, BoundsTheShareOfFurtherValuesBelow) {
  Random random(5);
  int below = 0, total = 0;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 500; ++i) values.push_back(random.uniform());
    const double bound = conformal_lower_bound(values, 0.02);
    for (int i = 0; i < 500; ++i, ++total) below += random.uniform() < bound;
  }
  EXPECT_LE(double(below) / total, 0.023);
  EXPECT_LT(conformal_lower_bound({0.5, 0.7}, 0.02), 0.5) << "too few values for a bound";
}

}  // namespace
}  // namespace edgevo::training
