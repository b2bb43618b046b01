// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/pose_covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace edgevo {
namespace {

// px^2: matches without any residual are a coincidence, not a certainty.
constexpr double kMinResidualVariance = 0.01;
constexpr double kInformationRidge = 1e-9;  // px^-2, added to the information to make it invertible
constexpr double kPoseFreedom = 6.0;        // unknowns of a pose

// Sum of the scores of each edge, in the order of the edges' numbers.
std::vector<Vector6d> sum_scores(const std::vector<PoseEquation>& equations) {
  int edges = 0;
  for (const PoseEquation& e : equations) edges = std::max(edges, e.edge + 1);
  std::vector<Vector6d> score(size_t(edges), Vector6d::Zero());
  std::vector<bool> present(size_t(edges), false);
  for (const PoseEquation& e : equations) {
    score[size_t(e.edge)] += (e.weight * e.residual_px) * e.jacobian.transpose();
    present[size_t(e.edge)] = true;
  }
  std::vector<Vector6d> scores;
  for (size_t i = 0; i < score.size(); ++i)
    if (present[i]) scores.push_back(score[i]);
  return scores;
}

}  // namespace

Matrix6d pose_covariance(const std::vector<PoseEquation>& equations) {
  Matrix6d A = kInformationRidge * Matrix6d::Identity();
  double square = 0, weight = 0;
  for (const PoseEquation& e : equations) {
    A.noalias() += e.weight * e.jacobian.transpose() * e.jacobian;
    square += (e.weight * e.residual_px) * (e.weight * e.residual_px);
    weight += e.weight;
  }
  const double variance = std::max(kMinResidualVariance, weight > 0 ? square / weight : 0.0);  // sigma_r^2
  const std::vector<Vector6d> scores = sum_scores(equations);
  Matrix6d M = Matrix6d::Zero();
  for (const Vector6d& g : scores) M.noalias() += g * g.transpose();
  const double n = double(scores.size());
  M *= n / std::max(1.0, n - kPoseFreedom);
  // In the axes in which A is the identity (A = L L^T), M is the variance of a residual including the error
  // shared along its edge.
  const Matrix6d L_inverse = A.llt().matrixL().solve(Matrix6d::Identity());
  const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(L_inverse * M * L_inverse.transpose());
  const Matrix6d root = L_inverse.transpose() * axes.eigenvectors();
  return kReferenceShare * root * axes.eigenvalues().cwiseMax(variance).asDiagonal() * root.transpose();
}

Matrix6d unit_covariance(const SE3& T_cur_ref) {
  constexpr double kDrift = 0.01;
  const Eigen::Vector3d error = kDrift * T_cur_ref.translation();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = error * error.transpose();
  return covariance;
}

double normalised_error_square(const SE3& T_estimate, const SE3& T_true, const Matrix6d& covariance) {
  const Vector6d xi = (T_estimate * T_true.inverse()).log();
  Vector6d u = Vector6d::Zero();
  u.head<3>() = T_estimate.translation();
  const Eigen::LLT<Matrix6d> factor(covariance);
  const double length = u.dot(factor.solve(u));
  const Vector6d rest = length > 0 ? Vector6d(xi - u * (u.dot(factor.solve(xi)) / length)) : xi;
  return rest.dot(factor.solve(rest));
}

}  // namespace edgevo
