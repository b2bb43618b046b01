// SPDX-License-Identifier: BSD-3-Clause
// SE(3): against the matrix exponential, numeric derivatives and the group axioms.
#include "edgevo/core/se3.h"

#include <gmock/gmock.h>

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "edgevo/core/random.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

Eigen::Vector3d random_direction(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

// Tangent with a rotation of `angle` and a translation part of `length`, both in random directions.
Vector6d random_tangent(Random& random, double length, double angle) {
  Vector6d xi;
  xi << length * random_direction(random), angle * random_direction(random);
  return xi;
}

Eigen::Matrix4d hat(const Vector6d& xi) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  M.topLeftCorner<3, 3>() = skew(xi.tail<3>());
  M.topRightCorner<3, 1>() = xi.head<3>();
  return M;
}

SE3 random_motion(Random& random) { return SE3::exp(random_tangent(random, 3.0, random.uniform(0, 3.0))); }

const double kAngles[] = {0.0,    1e-12, 1e-9, 1e-7, 0.99e-5, 1.01e-5,     1e-4,        0.0099,
                          0.0101, 0.1,   1.0,  2.5,  3.0,     M_PI - 1e-3, M_PI - 1e-6, M_PI - 1e-9};

TEST(SE3, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a(1, -2, 3), b(0.5, 4, -1);
  EXPECT_TRUE((skew(a) * b).isApprox(a.cross(b), 1e-15));
}

TEST(SE3, ExpIsTheMatrixExponential) {
  Random random(1);
  for (double angle : kAngles)
    for (int trial = 0; trial < 20; ++trial) {
      const Vector6d xi = random_tangent(random, 5.0, angle);
      const Eigen::Matrix4d expected = Eigen::Matrix4d(hat(xi)).exp();
      EXPECT_LT((SE3::exp(xi).matrix() - expected).norm(), 5e-14) << "angle " << angle;
    }
}

TEST(SE3, ExpMovesTheTranslationAlongTheArc) {
  Vector6d xi;  // a quarter of a circle of radius 2/pi, arc length 1
  xi << 1, 0, 0, 0, 0, M_PI / 2;
  EXPECT_TRUE(SE3::exp(xi).translation().isApprox(Eigen::Vector3d(2 / M_PI, 2 / M_PI, 0), 1e-15));
}

TEST(SE3, LogUndoesExpFromZeroToPi) {
  Random random(2);
  for (double angle : kAngles)
    for (int trial = 0; trial < 20; ++trial) {
      const Vector6d xi = random_tangent(random, 5.0, angle);
      EXPECT_LT((SE3::exp(xi).log() - xi).norm(), 1e-13 * (1 + xi.norm())) << "angle " << angle;
    }
}

TEST(SE3, ExpUndoesLogAtPiExactly) {
  for (int axis = 0; axis < 3; ++axis) {
    Vector6d xi = Vector6d::Zero();
    xi[0] = 2, xi[1] = -1;
    xi[3 + axis] = M_PI;
    const SE3 T = SE3::exp(xi);
    EXPECT_NEAR(T.log().tail<3>().norm(), M_PI, 1e-12);
    EXPECT_LT((SE3::exp(T.log()).matrix() - T.matrix()).norm(), 1e-12);
  }
}

TEST(SE3, LogIsShortestForEitherSignOfTheQuaternion) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  const SE3 T(q, Eigen::Vector3d(1, 2, 3)), same(Eigen::Quaterniond(-q.coeffs()), Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((T.log() - same.log()).norm(), 1e-14);
  EXPECT_NEAR(same.angle(), 0.3, 1e-14);
}

TEST(SE3, InverseAndProductAgreeWithMatrices) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const SE3 A = random_motion(random), B = random_motion(random);
    EXPECT_LT(((A * B).matrix() - A.matrix() * B.matrix()).norm(), 1e-13);
    EXPECT_LT((A.inverse().matrix() - A.matrix().inverse()).norm(), 1e-13);
    const Eigen::Vector3d p = 10 * random_direction(random);
    EXPECT_LT((A * p - (A.matrix() * p.homogeneous()).head<3>()).norm(), 1e-13);
  }
}

TEST(SE3, AdjointMovesTheTangentToTheOtherSide) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const SE3 T = random_motion(random);
    const Vector6d xi = random_tangent(random, 1.0, random.uniform(0, 2.0));
    const SE3 left = SE3::exp(T.adjoint() * xi), right = T * SE3::exp(xi) * T.inverse();
    EXPECT_LT((left.matrix() - right.matrix()).norm(), 1e-12);
  }
}

TEST(SE3, JacobianOfALeftPerturbation) {
  Random random(5);
  const SE3 T_a_b = random_motion(random);
  const Eigen::Vector3d p_b(1, -2, 4), p_a = T_a_b * p_b;
  Eigen::Matrix<double, 3, 6> analytic;
  analytic << Eigen::Matrix3d::Identity(), -skew(p_a);
  const auto moved = [&](const Vector6d& d) { return SE3::exp(d) * T_a_b * p_b; };
  EXPECT_THAT(analytic, test::JacobianNear(test::numerical_jacobian<6>(moved), 1e-9));
}

// A product of rounded rotations that is not normalised doubles its error in every step of T * T^-1 chains.
TEST(SE3, TenThousandCompositionsStayRotations) {
  Vector6d xi;
  xi << 1e-2, -2e-2, 3e-2, 1e-3, 2e-3, -1.5e-3;
  const SE3 step = SE3::exp(xi);
  SE3 T, previous;
  for (int i = 0; i < 10000; ++i) {
    previous = T;
    T = T * step;
    const SE3 velocity = previous.inverse() * T;  // what a constant-velocity model does in every frame
    T = previous * velocity;
  }
  EXPECT_LT((T.R().transpose() * T.R() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(T.rotation().norm(), 1.0, 1e-14);
  EXPECT_LT((T.matrix() - SE3::exp(10000 * xi).matrix()).norm(), 1e-8);
}

TEST(SE3, NormalisesItsRotation) {
  const SE3 T(Eigen::Quaterniond(2, 0, 0, 2), Eigen::Vector3d::Zero());
  EXPECT_NEAR(T.rotation().norm(), 1.0, 1e-15);
  EXPECT_NEAR(T.angle(), M_PI / 2, 1e-15);
}

TEST(SE3, DetectsValuesThatAreNotFinite) {
  EXPECT_TRUE(SE3().is_finite());
  EXPECT_FALSE(SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, std::nan(""), 0)).is_finite());
  EXPECT_FALSE(SE3(Eigen::Quaterniond(std::nan(""), 0, 0, 1), Eigen::Vector3d::Zero()).is_finite());
}

}  // namespace
}  // namespace edgevo
