// SPDX-License-Identifier: BSD-3-Clause
// Sim(3): against the matrix exponential, SE(3), numeric derivatives and the group axioms.
#include "edgevo/core/sim3.h"

#include <gmock/gmock.h>

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "edgevo/core/random.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

Eigen::Vector3d any_direction(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

Vector7d any_tangent(Random& random, double length, double angle, double log_scale) {
  Vector7d xi;
  xi << length * any_direction(random), angle * any_direction(random), log_scale;
  return xi;
}

Sim3 any_similarity(Random& random) {
  return Sim3::exp(any_tangent(random, 3, random.uniform(0, 3), 0.5 * random.normal()));
}

Eigen::Matrix4d matrix_of(const Sim3& T) {
  Eigen::Matrix4d M = T.rigid.matrix();
  M.topLeftCorner<3, 3>() *= T.scale;
  return M;
}

Eigen::Matrix4d algebra_matrix(const Vector7d& xi) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  M.topLeftCorner<3, 3>() = skew(xi.segment<3>(3)) + xi[6] * Eigen::Matrix3d::Identity();
  M.topRightCorner<3, 1>() = xi.head<3>();
  return M;
}

const double kTurns[] = {0, 1e-12, 1e-8, 1e-5, 1e-3, 0.1, 1, 2.5, M_PI - 1e-3, M_PI - 1e-6, M_PI - 1e-9};
const double kLogScales[] = {-std::log(1e3), -1,   -1e-3, -1e-6, -1e-10, 0,
                             1e-12,          1e-8, 1e-4,  0.1,   2,      std::log(1e3)};

TEST(Sim3, ExpIsTheMatrixExponential) {
  Random random(1);
  for (const double angle : kTurns)
    for (const double log_scale : kLogScales) {
      const Vector7d xi = any_tangent(random, 5, angle, log_scale);
      const Eigen::Matrix4d expected = algebra_matrix(xi).exp();
      EXPECT_LT((matrix_of(Sim3::exp(xi)) - expected).norm(), 1e-13 * (1 + expected.norm()))
          << "angle " << angle << ", log scale " << log_scale;
    }
}

TEST(Sim3, LogUndoesExpForAllAnglesAndScales) {
  Random random(2);
  for (const double angle : kTurns)
    for (const double log_scale : kLogScales) {
      const Vector7d xi = any_tangent(random, 5, angle, log_scale);
      EXPECT_LT((Sim3::exp(xi).log() - xi).norm(), 1e-12) << "angle " << angle << ", log scale " << log_scale;
    }
}

TEST(Sim3, WithoutScaleIsSE3) {
  Random random(3);
  for (const double angle : kTurns) {
    const Vector7d xi = any_tangent(random, 5, angle, 0);
    const SE3 T = SE3::exp(xi.head<6>());
    EXPECT_LT((Sim3::exp(xi).rigid.matrix() - T.matrix()).norm(), 1e-13) << angle;
    EXPECT_EQ(Sim3::exp(xi).scale, 1);
    EXPECT_LT(((Sim3{1, T}.log().head<6>()) - T.log()).norm(), 1e-12) << angle;
    EXPECT_LT((Sim3{1, T}.adjoint().topLeftCorner<6, 6>() - T.adjoint()).norm(), 1e-15) << angle;
  }
}

TEST(Sim3, KeepsTheLawsOfAGroup) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const Sim3 A = any_similarity(random), B = any_similarity(random), C = any_similarity(random);
    EXPECT_LT((matrix_of((A * B) * C) - matrix_of(A * (B * C))).norm(), 1e-11);
    EXPECT_LT((matrix_of(A * A.inverse()) - Eigen::Matrix4d::Identity()).norm(), 1e-12);
    EXPECT_LT((matrix_of((A * B).inverse()) - matrix_of(B.inverse() * A.inverse())).norm(), 1e-11);
    EXPECT_LT((matrix_of(A * B) - matrix_of(A) * matrix_of(B)).norm(), 1e-12);
  }
}

TEST(Sim3, AdjointMovesTheTangentToTheOtherSide) {
  Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Sim3 T = any_similarity(random);
    const Vector7d xi = any_tangent(random, 1, random.uniform(0, 2), 0.5 * random.normal());
    const Eigen::Matrix4d left = matrix_of(Sim3::exp(T.adjoint() * xi));
    EXPECT_LT((left - matrix_of(T * Sim3::exp(xi) * T.inverse())).norm(), 1e-11);
    EXPECT_LT((Matrix7d(sim3_ad(xi)).exp() - Sim3::exp(xi).adjoint()).norm(), 1e-12);
  }
}

TEST(Sim3, JacobiansAreTheDerivativesOfExpAndLog) {
  Random random(6);
  for (const double angle : {0.0, 1e-7, 0.3, 2.0, 3.0})
    for (const double log_scale : {-2.0, -1e-6, 0.0, 1e-3, 1.5}) {
      const Vector7d xi = any_tangent(random, 2, angle, log_scale);
      const auto moved = [&](const Vector7d& d) -> Vector7d {
        return (Sim3::exp(xi + d) * Sim3::exp(xi).inverse()).log();
      };
      const auto log_of = [&](const Vector7d& d) -> Vector7d { return (Sim3::exp(d) * Sim3::exp(xi)).log(); };
      EXPECT_THAT(sim3_left_jacobian(xi), test::JacobianNear(test::numerical_jacobian<7>(moved), 1e-6));
      EXPECT_THAT(sim3_left_jacobian_inverse(xi),
                  test::JacobianNear(test::numerical_jacobian<7>(log_of), 1e-6));
    }
}

TEST(Sim3, RightJacobianIsTheLeftOneOfTheOpposite) {
  Random random(7);
  const Vector7d xi = any_tangent(random, 2, 1.2, -0.4);
  const auto log_of = [&](const Vector7d& d) -> Vector7d { return (Sim3::exp(xi) * Sim3::exp(d)).log(); };
  EXPECT_THAT(sim3_left_jacobian_inverse(-xi), test::JacobianNear(test::numerical_jacobian<7>(log_of), 1e-6));
}

TEST(Sim3, ComposesAndInvertsAsItsEquationSays) {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Sim3 A{std::exp(random.normal()), any_similarity(random).rigid},
        B{std::exp(random.normal()), any_similarity(random).rigid};
    const Eigen::Vector3d p = 10 * any_direction(random);
    const Eigen::Vector3d direct = A.scale * (A.rigid.R() * p) + A.rigid.translation();
    EXPECT_LT((A * p - direct).norm(), 1e-12 * (1 + direct.norm()));
    EXPECT_LT(((A * B) * p - A * (B * p)).norm(), 1e-12 * (1 + (A * (B * p)).norm()));
    EXPECT_LT((A.inverse() * (A * p) - p).norm(), 1e-11);
    EXPECT_NEAR((A * A.inverse()).scale, 1.0, 1e-14);
  }
}

TEST(Sim3, MovesACameraWithoutStretchingIt) {
  Random random(7);
  const Sim3 S{2.5, any_similarity(random).rigid};
  const SE3 T_b_cam = any_similarity(random).rigid, T_a_cam = S.apply(T_b_cam);
  EXPECT_LT((T_a_cam.translation() - S * T_b_cam.translation()).norm(), 1e-13);
  EXPECT_LT((T_a_cam.R() - S.rigid.R() * T_b_cam.R()).norm(), 1e-13);
  // A point of the camera moves with it, its distance multiplied by the scale.
  const Eigen::Vector3d p_cam(0.3, -0.1, 4);
  EXPECT_LT((T_a_cam * (S.scale * p_cam) - S * (T_b_cam * p_cam)).norm(), 1e-12);
}

}  // namespace
}  // namespace edgevo
