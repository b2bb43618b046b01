// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/correlated_residual.h"

#include <algorithm>

#include "affine_sums.h"

namespace edgevo {

CorrelatedResidual correlated_residual(const std::vector<PoseEquation>& equations) {
  const AffineSums sums(equations);
  const Matrix6d X = sums.absorbed();
  const Matrix6d T = sums.of_affine - sums.across.transpose() * X;
  CorrelatedResidual found;
  found.per_px2 = std::max(0.0, T.trace());
  found.covariance = X * X.transpose();
  Vector6d S = Vector6d::Zero();
  Matrix6d by_chance = Matrix6d::Zero();
  for (const AffineScore& edge : sums.of_edge) {
    const Vector6d s = edge.by_affine - X.transpose() * edge.by_pose;
    S += s;
    by_chance.noalias() += s * s.transpose();
  }
  const double ridge = kAbsorbedShare * sums.of_affine.trace() + kPoseRidge;
  const Eigen::LDLT<Matrix6d> solver(T + ridge * Matrix6d::Identity());
  found.explained_px2 = S.dot(solver.solve(S)) - solver.solve(by_chance).trace();
  return found;
}

}  // namespace edgevo
