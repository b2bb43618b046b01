// SPDX-License-Identifier: BSD-3-Clause
// The covariance of a pose against the spread of many estimates, with independent and with shared noise.
#include "edgevo/alignment/pose_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/core/random.h"

namespace edgevo {
namespace {

// `edges` edges of `points` neighbouring points each, seen by a camera at rest.
std::vector<PoseEquation> make_equations(int edges, int points) {
  const Pinhole camera{260, 260, 160, 120, 320, 240};
  Random random(5);
  std::vector<PoseEquation> equations;
  for (int edge = 0; edge < edges; ++edge) {
    const Eigen::Vector2d px(random.uniform(10, 310), random.uniform(10, 230));
    const double angle = random.uniform(0, 2 * M_PI), idepth = random.uniform(0.1, 0.5);
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle)), along(-normal.y(), normal.x());
    for (int i = 0; i < points; ++i) {
      const Eigen::Vector2d at = px + 3.0 * i * along;
      const EdgeResidual r = edge_residual(camera, SE3(), camera.ray(at), idepth, at, normal);
      equations.push_back({r.jacobian, 0, 1, edge});
    }
  }
  return equations;
}

// Estimates from noisy residuals: their sample covariance, and the mean of pose_covariance() without the
// share of the reference.
struct Spread {
  Matrix6d sampled = Matrix6d::Zero(), predicted = Matrix6d::Zero();
};

Spread sample(std::vector<PoseEquation> equations, double own_px, double shared_px) {
  constexpr int kTrials = 3000;
  Random random(7);
  Matrix6d A = Matrix6d::Zero();
  for (const PoseEquation& e : equations) A += e.jacobian.transpose() * e.jacobian;
  const auto solver = A.ldlt();
  Spread spread;
  for (int trial = 0; trial < kTrials; ++trial) {
    Vector6d b = Vector6d::Zero();
    double shared = 0;
    int edge = -1;
    for (PoseEquation& e : equations) {
      if (e.edge != edge) shared = shared_px * random.normal(), edge = e.edge;
      e.residual_px = own_px * random.normal() + shared;
      b += e.jacobian.transpose() * e.residual_px;
    }
    const Vector6d xi = solver.solve(b);
    for (PoseEquation& e : equations) e.residual_px -= e.jacobian.dot(xi);  // as the alignment leaves them
    spread.sampled += xi * xi.transpose() / kTrials;
    spread.predicted += pose_covariance(equations) / (kReferenceShare * kTrials);
  }
  return spread;
}

// Mean ratio of sampled to predicted variance, in the axes of the prediction.
double variance_ratio(const Spread& s) { return (s.predicted.inverse() * s.sampled).trace() / 6; }

TEST(PoseCovariance, MatchesTheSpreadUnderIndependentNoise) {
  const Spread s = sample(make_equations(150, 4), 0.4, 0);
  EXPECT_GT(variance_ratio(s), 0.65);  // bounded below by A^-1 sigma^2, so on the safe side
  EXPECT_LT(variance_ratio(s), 1.05);
}

TEST(PoseCovariance, MatchesTheSpreadWherePointsOfAnEdgeShareItsError) {
  const Spread s = sample(make_equations(150, 4), 0.2, 0.4);
  EXPECT_GT(variance_ratio(s), 0.75);
  EXPECT_LT(variance_ratio(s), 1.15);
}

// Every point as an edge of its own: the result of the formula for independent residuals.
TEST(PoseCovariance, AssumingIndependenceIsOverconfident) {
  std::vector<PoseEquation> equations = make_equations(150, 4);
  const double shared = sample(equations, 0.2, 0.4).predicted.trace();
  for (size_t i = 0; i < equations.size(); ++i) equations[i].edge = int(i);
  EXPECT_GT(shared / sample(equations, 0.45, 0).predicted.trace(), 2);
}

// A single direction of motion that no edge observes must not appear certain.
TEST(PoseCovariance, AnUnobservedDirectionIsUnknown) {
  std::vector<PoseEquation> equations = make_equations(100, 3);
  Random random(3);
  for (PoseEquation& e : equations) {
    e.jacobian[1] = 0;
    e.residual_px = 0.3 * random.normal();
  }
  const Matrix6d covariance = pose_covariance(equations);
  EXPECT_GT(covariance(1, 1), 1e6);
  EXPECT_LT(covariance(0, 0), 1);
}

// Errors drawn from a covariance: the mean of their normalised squares is the number of degrees of freedom,
// and a component along the translation adds nothing.
TEST(PoseCovariance, NormalisedErrorHasFiveDegreesOfFreedom) {
  const Matrix6d covariance = pose_covariance([] {
    std::vector<PoseEquation> equations = make_equations(100, 3);
    Random noise(3);
    for (PoseEquation& e : equations) e.residual_px = 0.3 * noise.normal();
    return equations;
  }());
  const Matrix6d root = covariance.llt().matrixL();
  const SE3 truth(Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX())),
                  Eigen::Vector3d(0.3, -0.1, 0.8));
  Random random(11);
  constexpr int kTrials = 4000;
  double sum = 0, with_length = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Vector6d noise;
    for (double& x : noise) x = random.normal();
    const SE3 estimate = SE3::exp(root * noise) * truth;
    sum += normalised_error_square(estimate, truth, covariance) / kTrials;
    const SE3 longer(estimate.rotation(), 1.01 * estimate.translation());
    with_length += normalised_error_square(longer, truth, covariance) / kTrials;
  }
  EXPECT_NEAR(sum, kNormalisedErrorFreedom, 0.2);
  EXPECT_NEAR(with_length, sum, 0.05 * sum);
  EXPECT_EQ(normalised_error_square(truth, truth, covariance), 0);
}

TEST(PoseCovariance, OfTheUnitIsOnePerCentAlongTheTranslation) {
  const SE3 T(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 3, 4));
  const Matrix6d covariance = unit_covariance(T);
  Vector6d along = Vector6d::Zero();
  along.head<3>() = T.translation() / 5;
  EXPECT_NEAR(along.dot(covariance * along), 0.05 * 0.05, 1e-12);
  EXPECT_NEAR(covariance.trace(), 0.05 * 0.05, 1e-12) << "nothing across it, nothing of the rotation";
}

TEST(PoseCovariance, WithoutEquationsNothingIsKnown) {
  const Matrix6d covariance = pose_covariance({});
  EXPECT_TRUE(covariance.allFinite());
  EXPECT_GT(covariance.diagonal().minCoeff(), 1e6);
}

}  // namespace
}  // namespace edgevo
