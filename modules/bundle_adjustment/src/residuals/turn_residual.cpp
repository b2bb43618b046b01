// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/turn_residual.h"

#include <cmath>

#include "edgevo/core/robust.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo::ba {

Eigen::Vector3d turn_residual(const SE3& T_to_from, const BaTurn& turn) {
  return rotation_vector(T_to_from.rotation() * turn.R_to_from.conjugate());
}

double TurnTerm::cost(const std::vector<SE3>& poses) const {
  double cost = 0;
  for (const BaTurn& t : turns_) {
    const Eigen::Vector3d w = turn_residual(poses[t.to] * poses[t.from].inverse(), t);
    cost += huber_cost(std::sqrt(w.dot(t.information * w)), huber_width_);
  }
  return cost;
}

double TurnTerm::add(const std::vector<SE3>& poses, Eigen::MatrixXd* H, Eigen::VectorXd* b) const {
  double cost = 0;
  for (const BaTurn& t : turns_) {
    const int from = 6 * t.from + 3, to = 6 * t.to + 3;  // of the rotations
    const SE3 T_to_from = poses[t.to] * poses[t.from].inverse();
    const Eigen::Vector3d w = turn_residual(T_to_from, t);
    const double sigmas = std::sqrt(w.dot(t.information * w));
    const Eigen::Matrix3d A = huber_weight(sigmas, huber_width_) * t.information, R = T_to_from.R(),
                          A_R = A * R;
    H->block<3, 3>(to, to) += A;
    H->block<3, 3>(to, from) -= A_R;
    H->block<3, 3>(from, to) -= A_R.transpose();
    H->block<3, 3>(from, from) += R.transpose() * A_R;
    b->segment<3>(to) += A * w;
    b->segment<3>(from) -= A_R.transpose() * w;
    cost += huber_cost(sigmas, huber_width_);
  }
  return cost;
}

}  // namespace edgevo::ba
