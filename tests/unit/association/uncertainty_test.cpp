// SPDX-License-Identifier: BSD-3-Clause
// Uncertainty against Monte Carlo on a synthetic edge; match confidence.
#include "edgevo/association/uncertainty.h"

#include <gtest/gtest.h>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/random.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

struct SyntheticEdge {
  Pinhole camera{500, 500, 320, 240, 640, 480};
  SE3 T = SE3::exp(twist(0.3, 0.05, 0.1, 0.01, -0.02, 0.015));
  Eigen::Vector3d ray{0.2, -0.1, 1};
  double idepth = 0.4, idepth_sigma = 0.004;
  Matrix6d Sigma_xi;
  SyntheticEdge() {
    Random random(8);
    Matrix6d A;
    for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = 2e-4 * random.normal();
    Sigma_xi = A * A.transpose() + 1e-9 * Matrix6d::Identity();
  }
  Eigen::Vector2d px(const SE3& pose, double d) const {
    return project(camera, pose.R(), pose.translation(), ray, d).px;
  }
};

TEST(Uncertainty, ProjectionCovarianceMatchesMonteCarlo) {
  const SyntheticEdge s;
  const Projection at = project(s.camera, s.T.R(), s.T.translation(), s.ray, s.idepth);
  const Eigen::Matrix2d expected = projection_covariance(s.camera, at.Y, s.idepth, s.Sigma_xi);
  const Matrix6d L = s.Sigma_xi.llt().matrixL();
  Random random(1);
  Eigen::Matrix2d sampled = Eigen::Matrix2d::Zero();
  constexpr int kTrials = 20000;
  for (int t = 0; t < kTrials; ++t) {
    Vector6d z;
    for (int i = 0; i < 6; ++i) z[i] = random.normal();
    const Eigen::Vector2d d = s.px(SE3::exp(L * z) * s.T, s.idepth) - at.px;
    sampled += d * d.transpose() / kTrials;
  }
  EXPECT_LT((sampled - expected).norm(), 0.05 * expected.norm());
  for (double angle : {0.0, 0.7, 1.9}) {
    const Eigen::Vector2d a(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(sigma_along(expected, a), std::sqrt(a.dot(sampled * a)),
                0.05 * std::sqrt(a.dot(sampled * a)));
  }
}

// lambda is where the epipolar line of the perturbed point crosses the edge, Eq. (intersection): its spread
// along the edge must be sigma_lambda, and the search length must cover it.
TEST(Uncertainty, SearchLengthMatchesTheSpreadOfMatchesAlongTheEdge) {
  const SyntheticEdge s;
  const Projection at = project(s.camera, s.T.R(), s.T.translation(), s.ray, s.idepth);
  const Eigen::Matrix2d Sigma_p = projection_covariance(s.camera, at.Y, s.idepth, s.Sigma_xi);
  const DepthMotion depth = depth_motion(s.camera, s.T, s.ray, s.idepth, s.idepth_sigma);
  const Matrix6d L = s.Sigma_xi.llt().matrixL();
  for (double angle : {0.1, 0.8, 1.4, 2.3}) {
    const Eigen::Vector2d g(std::cos(angle), std::sin(angle)), g_perp(-g.y(), g.x());
    Random random(2);
    double square = 0;
    constexpr int kTrials = 20000;
    int covered = 0;
    const double half = search_half_length(Sigma_p, depth, g, 1, 1);
    for (int t = 0; t < kTrials; ++t) {
      Vector6d z;
      for (int i = 0; i < 6; ++i) z[i] = random.normal();
      // The true point, displaced by the errors of the estimate: its offset along the edge from the
      // prediction.
      const Eigen::Vector2d d =
          s.px(SE3::exp(L * z) * s.T, s.idepth + s.idepth_sigma * random.normal()) - at.px;
      const double lambda = g_perp.dot(d);
      square += lambda * lambda / kTrials;
      covered += std::abs(lambda) <= half;
    }
    EXPECT_NEAR(std::sqrt(search_variance(Sigma_p, depth, g)), std::sqrt(square), 0.06 * std::sqrt(square))
        << angle;
    EXPECT_GE(half, 0.98 * std::sqrt(square))
        << "the sum bounds the root of squares, Eq. (uncertaintyseperation)";
    EXPECT_GT(double(covered) / kTrials, 0.66);
  }
}

// sigma_mu of Eq. (depthuncertainty): mu = e_(p||g) / cos theta, so its spread is sigma_(p||g) / |cos theta|
// = 1 / C_d.
TEST(Uncertainty, DepthConfidenceMatchesTheSpreadOfTheIntersection) {
  const SyntheticEdge s;
  const Projection at = project(s.camera, s.T.R(), s.T.translation(), s.ray, s.idepth);
  const Eigen::Matrix2d Sigma_p = projection_covariance(s.camera, at.Y, s.idepth, s.Sigma_xi);
  const Eigen::Vector2d l = depth_motion(s.camera, s.T, s.ray, s.idepth, s.idepth_sigma).direction;
  const Matrix6d L = s.Sigma_xi.llt().matrixL();
  for (double angle : {0.2, 0.9, 2.0}) {
    const Eigen::Vector2d g(std::cos(angle), std::sin(angle));
    Random random(4);
    double square = 0;
    constexpr int kTrials = 20000;
    for (int t = 0; t < kTrials; ++t) {
      Vector6d z;
      for (int i = 0; i < 6; ++i) z[i] = random.normal();
      const Eigen::Vector2d p = s.px(SE3::exp(L * z) * s.T, s.idepth);
      square += std::pow(g.dot(at.px - p) / g.dot(l), 2) / kTrials;  // Eq. (depth)
    }
    EXPECT_NEAR(depth_confidence(Sigma_p, l, g, 1e-9) * std::sqrt(square), 1.0, 0.06) << angle;
  }
}

TEST(Uncertainty, DepthMotionFollowsTheEpipolarLine) {
  const SyntheticEdge s;
  const DepthMotion m = depth_motion(s.camera, s.T, s.ray, s.idepth, s.idepth_sigma);
  const Eigen::Vector2d up = s.px(s.T, s.idepth + s.idepth_sigma) - s.px(s.T, s.idepth);
  const Eigen::Vector2d down = s.px(s.T, s.idepth - s.idepth_sigma) - s.px(s.T, s.idepth);
  EXPECT_NEAR(m.sigma_mu_px, std::max(up.norm(), down.norm()), 1e-12);
  EXPECT_GT(m.direction.dot(up.normalized()), 0.999);
  EXPECT_EQ(depth_motion(s.camera, SE3(), s.ray, s.idepth, s.idepth_sigma).sigma_mu_px, 0) << "no baseline";
}

TEST(Aml, OneClearMinimumIsConfidentAndEqualCostsAreNot) {
  const double clear[] = {0.9, 0.8, 0.1, 0.8, 0.9}, flat[] = {0.1, 0.1, 0.1, 0.1, 0.1},
               two[] = {0.1, 0.9, 0.1, 0.9};
  EXPECT_NEAR(aml_confidence(clear, 5, 0.1, 0.08), 1.0, 1e-6);
  EXPECT_NEAR(aml_confidence(flat, 5, 0.1, 0.08), 0.2, 1e-12);
  EXPECT_NEAR(aml_confidence(two, 4, 0.1, 0.08), 0.5, 1e-6);
}

// With Gaussian cost noise, C_m is the attainable likelihood: among candidates whose true costs are known, a
// match with higher C_m is more often the right one.
TEST(Aml, RanksMatchesAsMonteCarloDoes) {
  Random random(6);
  int right_high = 0, n_high = 0, right_low = 0, n_low = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    double cost[9];
    const double contrast = random.uniform(0, 0.6);
    for (int i = 0; i < 9; ++i) cost[i] = contrast * std::abs(i - 4) / 4.0 + 0.05 * random.normal();
    const int best = int(std::min_element(cost, cost + 9) - cost);
    const bool confident = aml_confidence(cost, 9, cost[best], 0.08) >= 0.3;
    (confident ? n_high : n_low)++;
    (confident ? right_high : right_low) += std::abs(best - 4) <= 1;
  }
  ASSERT_GT(n_high, 1000);
  ASSERT_GT(n_low, 1000);
  EXPECT_GT(double(right_high) / n_high, double(right_low) / n_low + 0.2);
}

}  // namespace
}  // namespace edgevo
