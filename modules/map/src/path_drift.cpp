// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/path_drift.h"

#include "epoch_constraints.h"

namespace edgevo {

Matrix7d step_covariance(const SE3& T_a_b, const std::optional<Matrix6d>& adjusted) {
  Matrix7d covariance =
      covariance_of(kStepShare * T_a_b.translation().norm() + kLeastStep, kStepRotation, kUnitDrift);
  if (adjusted) covariance.topLeftCorner<6, 6>() += *adjusted;
  return covariance;
}

Matrix7d path_covariance(const std::vector<PathStep>& steps) {
  Matrix7d covariance = Matrix7d::Zero();
  SE3 T_first_a;
  for (const PathStep& step : steps) {
    const Matrix7d moved = Sim3{1, T_first_a}.adjoint();
    covariance += moved * step_covariance(step.T_a_b, step.adjusted) * moved.transpose();
    T_first_a = T_first_a * step.T_a_b;
  }
  return covariance;
}

}  // namespace edgevo
