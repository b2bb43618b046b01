// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/se3.h"

#include <Eigen/LU>
#include <cmath>

namespace edgevo {
namespace {

// rad: below it the third term of each series is less than the rounding error.
constexpr double kSmallAngle = 1e-5;
// rad: below it the closed form of C loses digits long before the series does.
constexpr double kSeriesAngle = 1e-2;

// V(w) of exp([v, w]) = (exp(w), V v):  V = I + B [w]x + C [w]x^2.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double theta2 = w.squaredNorm();
  const double theta = std::sqrt(theta2);
  const Eigen::Matrix3d W = skew(w);
  double B = 0.5 - theta2 / 24.0;
  double C = 1.0 / 6.0 - theta2 / 120.0;
  if (theta > kSmallAngle) {
    B = 2.0 * std::pow(std::sin(0.5 * theta), 2) / theta2;  // (1 - cos) / theta^2 without cancellation
    C = (theta - std::sin(theta)) / (theta2 * theta);
  }
  if (theta < kSeriesAngle) C = 1.0 / 6.0 - theta2 / 120.0 + theta2 * theta2 / 5040.0;
  return Eigen::Matrix3d::Identity() + B * W + C * W * W;
}

Eigen::Quaterniond exp_so3(const Eigen::Vector3d& w) {
  const double theta = w.norm();
  const double half = 0.5 * theta;
  const double k = theta < kSmallAngle ? 0.5 - theta * theta / 48.0 : std::sin(half) / theta;
  return Eigen::Quaterniond(std::cos(half), k * w.x(), k * w.y(), k * w.z()).normalized();
}

Eigen::Vector3d log_so3(const Eigen::Quaterniond& q_in) {
  const Eigen::Quaterniond q = q_in.w() < 0 ? Eigen::Quaterniond(-q_in.coeffs()) : q_in;
  const double n = q.vec().norm();
  if (n < kSmallAngle) return 2.0 * q.vec() * (1.0 + n * n / 6.0);
  return 2.0 * std::atan2(n, q.w()) / n * q.vec();
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d S;
  S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return S;
}

SE3 SE3::exp(const Vector6d& xi) {
  const Eigen::Vector3d w = xi.tail<3>();
  return {exp_so3(w), left_jacobian(w) * xi.head<3>()};
}

Vector6d SE3::log() const {
  const Eigen::Vector3d w = log_so3(q_);
  Vector6d xi;
  xi << left_jacobian(w).inverse() * t_, w;
  return xi;
}

SE3 SE3::inverse() const {
  const Eigen::Quaterniond qi = q_.conjugate();
  return {qi, -(qi * t_)};
}

Matrix6d SE3::adjoint() const {
  const Eigen::Matrix3d rot = R();
  Matrix6d A;
  A << rot, skew(t_) * rot, Eigen::Matrix3d::Zero(), rot;
  return A;
}

Eigen::Matrix4d SE3::matrix() const {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = R();
  M.topRightCorner<3, 1>() = t_;
  return M;
}

double SE3::angle() const { return 2.0 * std::atan2(q_.vec().norm(), std::abs(q_.w())); }

}  // namespace edgevo
