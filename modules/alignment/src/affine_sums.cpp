// SPDX-License-Identifier: BSD-3-Clause
#include "affine_sums.h"

#include <algorithm>

namespace edgevo {
namespace {

// Derivative of the residual by the coefficients of the affine motion.
Vector6d affine_derivative(const PoseEquation& e) {
  Vector6d b;
  b << e.normal.x(), e.normal.x() * e.at.x(), e.normal.x() * e.at.y(), e.normal.y(), e.normal.y() * e.at.x(),
      e.normal.y() * e.at.y();
  return b;
}

}  // namespace

AffineSums::AffineSums(const std::vector<PoseEquation>& equations) {
  int edges = 0;
  for (const PoseEquation& e : equations) edges = std::max(edges, e.edge + 1);
  of_edge.resize(size_t(edges));
  for (const PoseEquation& e : equations) {
    const Vector6d b = affine_derivative(e), w_j = e.weight * e.jacobian.transpose(), w_b = e.weight * b;
    of_pose.noalias() += w_j * e.jacobian;
    across.noalias() += w_j * b.transpose();
    of_affine.noalias() += w_b * b.transpose();
    AffineScore& score = of_edge[size_t(e.edge)];
    score.by_pose += e.residual_px * w_j;
    score.by_affine += e.residual_px * w_b;
  }
}

Matrix6d AffineSums::absorbed() const {
  const Matrix6d A = of_pose + kPoseRidge * Matrix6d::Identity();
  return A.ldlt().solve(across);
}

}  // namespace edgevo
