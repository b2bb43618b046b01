// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/correlated_residual.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace edgevo {
namespace {

constexpr double kVarianceRidge = 1e-9;  // px^-2, added to the information of the pose: it is invertible then
constexpr double kAbsorbedShare = 1e-6;  // of the information of all fields: less is what the pose absorbs

// Derivative of the residual by the coefficients of the affine motion.
Vector6d affine_derivative(const PoseEquation& e) {
  Vector6d b;
  b << e.normal.x(), e.normal.x() * e.at.x(), e.normal.x() * e.at.y(), e.normal.y(), e.normal.y() * e.at.x(),
      e.normal.y() * e.at.y();
  return b;
}

// Weighted residuals times their derivatives.
struct Score {
  Vector6d by_pose = Vector6d::Zero(), by_affine = Vector6d::Zero();
};

struct Sums {
  Matrix6d of_pose = Matrix6d::Zero(), across = Matrix6d::Zero(), of_affine = Matrix6d::Zero();  // J, B
  std::vector<Score> of_edge;
};

Sums sum_up(const std::vector<PoseEquation>& equations) {
  int edges = 0;
  for (const PoseEquation& e : equations) edges = std::max(edges, e.edge + 1);
  Sums sums;
  sums.of_edge.resize(size_t(edges));
  for (const PoseEquation& e : equations) {
    const Vector6d b = affine_derivative(e), w_j = e.weight * e.jacobian.transpose(), w_b = e.weight * b;
    sums.of_pose.noalias() += w_j * e.jacobian;
    sums.across.noalias() += w_j * b.transpose();
    sums.of_affine.noalias() += w_b * b.transpose();
    Score& score = sums.of_edge[size_t(e.edge)];
    score.by_pose += e.residual_px * w_j;
    score.by_affine += e.residual_px * w_b;
  }
  return sums;
}

}  // namespace

CorrelatedResidual correlated_residual(const std::vector<PoseEquation>& equations) {
  const Sums sums = sum_up(equations);
  const Matrix6d A = sums.of_pose + kVarianceRidge * Matrix6d::Identity();
  const Matrix6d X = A.ldlt().solve(sums.across);
  const Matrix6d T = sums.of_affine - sums.across.transpose() * X;
  CorrelatedResidual found;
  found.per_px2 = std::max(0.0, T.trace());
  found.covariance = X * X.transpose();
  Vector6d S = Vector6d::Zero();
  Matrix6d by_chance = Matrix6d::Zero();
  for (const Score& edge : sums.of_edge) {
    const Vector6d s = edge.by_affine - X.transpose() * edge.by_pose;
    S += s;
    by_chance.noalias() += s * s.transpose();
  }
  const double ridge = kAbsorbedShare * sums.of_affine.trace() + kVarianceRidge;
  const Eigen::LDLT<Matrix6d> solver(T + ridge * Matrix6d::Identity());
  found.explained_px2 = S.dot(solver.solve(S)) - solver.solve(by_chance).trace();
  return found;
}

}  // namespace edgevo
