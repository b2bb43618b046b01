// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/similarity_fit.h"

#include <gtest/gtest.h>

#include "support/synthetic_trajectory.h"

namespace edgevo {
namespace {

Points random_points(int n, uint64_t seed) {
  Random random(seed);
  Points p(3, n);
  for (int i = 0; i < n; ++i)
    p.col(i) = Eigen::Vector3d(random.normal(), 3 * random.normal(), 10 * random.normal());
  return p;
}

Points mapped(const Sim3& S, const Points& p) {
  Points q = p;
  for (Eigen::Index i = 0; i < p.cols(); ++i) q.col(i) = S * Eigen::Vector3d(p.col(i));
  return q;
}

double residual(const Sim3& S, const Points& src, const Points& dst) {
  return (mapped(S, src) - dst).squaredNorm();
}

TEST(SimilarityFit, RecoversAKnownSimilarity) {
  const Sim3 truth = test::some_similarity();
  const Points src = random_points(50, 1);
  const auto fit = fit_sim3(src, mapped(truth, src));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, truth.scale, 1e-12);
  EXPECT_LT((fit->rigid.inverse() * truth.rigid).log().norm(), 1e-11);
}

TEST(SimilarityFit, RecoversAKnownRigidMotion) {
  const Sim3 truth{1.0, test::some_similarity().rigid};
  const Points src = random_points(50, 2);
  const auto fit = fit_se3(src, mapped(truth, src));
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->scale, 1.0);
  EXPECT_LT((fit->rigid.inverse() * truth.rigid).log().norm(), 1e-11);
}

TEST(SimilarityFit, IsALocalMinimumForNoisyPoints) {
  const Points src = random_points(40, 3);
  const Points dst = mapped(test::some_similarity(), src) + 0.3 * random_points(40, 4);
  const Sim3 best = *fit_sim3(src, dst);
  const double least = residual(best, src, dst);
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    Vector6d xi;
    for (int k = 0; k < 6; ++k) xi[k] = 0.02 * random.normal();
    const Sim3 other{best.scale * std::exp(0.02 * random.normal()), SE3::exp(xi) * best.rigid};
    EXPECT_GE(residual(other, src, dst), least);
  }
}

TEST(SimilarityFit, NeverMirrors) {
  Points src = random_points(30, 6);
  Points mirrored = src;
  mirrored.row(0) *= -1;
  const auto fit = fit_sim3(src, mirrored);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->rigid.R().determinant(), 1.0, 1e-12);
}

// The rotation about the line is undetermined; scale and residual are not.
TEST(SimilarityFit, AStraightLineHasAScale) {
  Points src = Points::Zero(3, 20);
  for (int i = 0; i < 20; ++i) src(2, i) = i;
  const Sim3 truth = test::some_similarity();
  const auto fit = fit_sim3(src, mapped(truth, src));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, truth.scale, 1e-10);
  EXPECT_LT(residual(*fit, src, mapped(truth, src)), 1e-20);
}

TEST(SimilarityFit, CoincidingOrTooFewPointsDefineNothing) {
  const Points points = random_points(10, 8);
  const Points one_place = Eigen::Vector3d(1, 2, 3).replicate(1, 10);
  EXPECT_FALSE(fit_sim3(one_place, points));
  EXPECT_FALSE(fit_sim3(points, one_place));
  EXPECT_FALSE(fit_sim3(Points::Zero(3, 10), points));
  EXPECT_FALSE(fit_sim3(points.leftCols(2), points.leftCols(2)));
  EXPECT_FALSE(fit_se3(points.leftCols(2), points.leftCols(2)));
}

TEST(SimilarityFit, SpreadIsTheRmsDistanceFromTheMean) {
  Points p(3, 2);
  p.col(0) << 1, 5, 0;
  p.col(1) << 1, 1, 0;
  EXPECT_DOUBLE_EQ(spread(p), 2.0);
  EXPECT_EQ(spread(Points(3, 0)), 0.0);
}

}  // namespace
}  // namespace edgevo
