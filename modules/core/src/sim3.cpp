// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/sim3.h"

#include <Eigen/LU>
#include <cmath>

namespace edgevo {
namespace {

// Spectral radius up to which the series below is summed: its 16 terms reach rounding error.
constexpr double kSeriesRadius = 0.5;
constexpr int kSeriesTerms = 16;

// phi(A) = sum of A^n / (n + 1)! = integral of exp(u A) over u in [0, 1], for the A of sim(3), whose
// eigenvalues are 0, sigma and sigma +- i |w|. `radius`: a bound of their size. The series is summed for A
// halved often enough, then doubled: phi(2 A) = phi(A) + phi(A) A phi(A) / 2. Nothing in it cancels at small
// angles or scales.
template <class Matrix>
Matrix phi(Matrix A, double radius) {
  int halvings = 0;
  for (; radius > kSeriesRadius; radius *= 0.5, A *= 0.5) ++halvings;
  Matrix sum = Matrix::Identity(), term = sum;
  for (int n = 1; n <= kSeriesTerms && !term.isZero(0); ++n) {
    const Matrix product = term * A / (n + 1);
    term = product;
    sum += term;
  }
  for (int k = 0; k < halvings; ++k, A *= 2) {
    const Matrix product = sum * A * sum;
    sum += 0.5 * product;
  }
  return sum;
}

double spectral_radius(const Vector7d& xi) { return xi.segment<3>(3).norm() + std::abs(xi[6]); }

// V of exp([v, w, sigma]) = (e^sigma, exp(w), V v).
Eigen::Matrix3d translation_map(const Vector7d& xi) {
  const Eigen::Matrix3d A = xi[6] * Eigen::Matrix3d::Identity() + skew(xi.segment<3>(3));
  return phi(A, spectral_radius(xi));
}

Vector6d rotation_only(const Eigen::Vector3d& w) {
  Vector6d xi = Vector6d::Zero();
  xi.tail<3>() = w;
  return xi;
}

}  // namespace

Sim3 Sim3::exp(const Vector7d& xi) {
  const SE3 turn = SE3::exp(rotation_only(xi.segment<3>(3)));
  return {std::exp(xi[6]), SE3(turn.rotation(), translation_map(xi) * xi.head<3>())};
}

Vector7d Sim3::log() const {
  Vector7d xi;
  xi << 0, 0, 0, SE3(rigid.rotation(), Eigen::Vector3d::Zero()).log().tail<3>(), std::log(scale);
  xi.head<3>() = translation_map(xi).inverse() * rigid.translation();
  return xi;
}

Sim3 Sim3::operator*(const Sim3& other) const {
  return {scale * other.scale,
          SE3(rigid.rotation() * other.rigid.rotation(), *this * other.rigid.translation())};
}

Sim3 Sim3::inverse() const {
  const Eigen::Quaterniond qi = rigid.rotation().conjugate();
  return {1.0 / scale, SE3(qi, -(qi * rigid.translation()) / scale)};
}

Matrix7d Sim3::adjoint() const {
  const Eigen::Matrix3d rot = rigid.R();
  Matrix7d A = Matrix7d::Identity();
  A.topLeftCorner<3, 3>() = scale * rot;
  A.block<3, 3>(0, 3) = skew(rigid.translation()) * rot;
  A.topRightCorner<3, 1>() = -rigid.translation();
  A.block<3, 3>(3, 3) = rot;
  return A;
}

SE3 Sim3::apply(const SE3& T_b_cam) const {
  return {rigid.rotation() * T_b_cam.rotation(), *this * T_b_cam.translation()};
}

Matrix7d sim3_ad(const Vector7d& xi) {
  const Eigen::Matrix3d W = skew(xi.segment<3>(3));
  Matrix7d A = Matrix7d::Zero();
  A.topLeftCorner<3, 3>() = xi[6] * Eigen::Matrix3d::Identity() + W;
  A.block<3, 3>(0, 3) = skew(xi.head<3>());
  A.topRightCorner<3, 1>() = -xi.head<3>();
  A.block<3, 3>(3, 3) = W;
  return A;
}

Matrix7d sim3_left_jacobian(const Vector7d& xi) { return phi(sim3_ad(xi), spectral_radius(xi)); }

Matrix7d sim3_left_jacobian_inverse(const Vector7d& xi) { return sim3_left_jacobian(xi).inverse(); }

}  // namespace edgevo
