// SPDX-License-Identifier: BSD-3-Clause
// The residual of a constraint: derivatives, whitening, and what it depends on.
#include "graph_residual.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/graph_scene.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

Sim3 any_similarity(Random& random) {
  Vector7d xi = test::normal_tangent(random);
  xi[6] *= 0.3;
  return Sim3::exp(xi);
}

Matrix7d full_covariance(Random& random) {
  Matrix7d A;
  for (int k = 0; k < 7; ++k) A.col(k) = 0.1 * test::normal_tangent(random);
  return A * A.transpose() + 1e-3 * Matrix7d::Identity();
}

TEST(GraphResidual, HasItsJacobians) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    Constraint c;
    if (trial % 2) c.covariance = test::covariance_of(1, 1, test::kUnmeasured);
    c.T_from_to = any_similarity(random);
    c.centre = 2 * test::normal_tangent(random).head<3>();
    const Sim3 from = any_similarity(random), to = any_similarity(random);
    const auto of_from = [&](const Vector7d& d) { return graph_error(c, from * Sim3::exp(d), to); };
    const auto of_to = [&](const Vector7d& d) { return graph_error(c, from, to * Sim3::exp(d)); };
    const GraphResidual r = graph_residual(c, from, to);
    EXPECT_THAT(r.J_from, test::JacobianNear(test::numerical_jacobian<7>(of_from), 1e-6));
    EXPECT_THAT(r.J_to, test::JacobianNear(test::numerical_jacobian<7>(of_to), 1e-6));
    EXPECT_EQ(r.xi, graph_error(c, from, to));
  }
}

TEST(GraphResidual, WhitensByTheWholeCovariance) {
  Random random(7);
  Constraint c;
  c.covariance = full_covariance(random);
  const GraphMode mode = graph_modes(c)[0];
  EXPECT_LT((mode.whitening * c.covariance * mode.whitening.transpose() - Matrix7d::Identity()).norm(), 1e-9);
  EXPECT_NEAR(mode.normalisation, std::log(c.covariance.determinant()), 1e-9);
}

TEST(GraphResidual, IsThePerturbationOfTheMeasurement) {
  Random random(2);
  Constraint c;
  c.T_from_to = any_similarity(random);
  const Sim3 from = any_similarity(random);
  const Vector7d xi = 0.3 * test::normal_tangent(random);
  EXPECT_LT((graph_error(c, from, from * Sim3::exp(xi) * c.T_from_to) - xi).norm(), 1e-12);
}

// Else a free scale would run off to make any translation agree.
TEST(GraphResidual, DoesNotDependOnWhatIsFree) {
  Random random(8);
  Constraint c;
  c.T_from_to = any_similarity(random);
  c.centre = c.T_from_to.rigid.translation();
  c.covariance = test::covariance_of(1, test::kUnmeasured, test::kUnmeasured);
  const Sim3 from = any_similarity(random), to = any_similarity(random);
  const Sim3 other{30 * to.scale, SE3(any_similarity(random).rigid.rotation(), to.rigid.translation())};
  EXPECT_LT((graph_error(c, from, to) - graph_error(c, from, other)).head<3>().norm(), 1e-12);
  EXPECT_LT(graph_residual(c, from, to).J_to.topRightCorner(3, 4).norm(), 1e-12);
}

}  // namespace
}  // namespace edgevo
