// SPDX-License-Identifier: BSD-3-Clause
#include "graph_residual.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace edgevo {
namespace {

Sim3 shifted(const Sim3& T, const Eigen::Vector3d& t) {
  return {T.scale, SE3::from_unit(T.rigid.rotation(), T.rigid.translation() + t)};
}

// Directions with a variance to divide by.
std::vector<int> weighted_directions(const Constraint& c) {
  std::vector<int> directions;
  for (int k = 0; k < 7; ++k)
    if (is_measured(c, k) && !(k == 6 && has_exact_scale(c))) directions.push_back(k);
  return directions;
}

GraphMode mode_of(const Matrix7d& covariance, const std::vector<int>& directions, double probability) {
  const auto n = static_cast<Eigen::Index>(directions.size());
  Eigen::MatrixXd sigma(n, n), select = Eigen::MatrixXd::Zero(n, 7);
  for (Eigen::Index i = 0; i < n; ++i) {
    select(i, directions[i]) = 1;
    for (Eigen::Index j = 0; j < n; ++j) sigma(i, j) = covariance(directions[i], directions[j]);
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(sigma);
  GraphMode mode;
  mode.whitening = llt.matrixL().solve(select);
  mode.normalisation = -2 * std::log(probability);
  for (Eigen::Index i = 0; i < n; ++i) mode.normalisation += 2 * std::log(llt.matrixLLT()(i, i));
  return mode;
}

bool measures_all(const Constraint& c) {
  for (int k = 0; k < 7; ++k)
    if (!is_measured(c, k)) return false;
  return true;
}

// xi of a similarity D. log() couples its directions: v = V(w, sigma)^-1 t tends to 0 where sigma grows, so
// that a scale which is free would run off to make any v small. Where a direction is free none may depend on
// it: D is a translation v after a turn w after a scaling sigma.
Vector7d coordinates(const Constraint& c, const Sim3& D) {
  if (measures_all(c)) return D.log();
  Vector7d xi;
  xi << D.rigid.translation(), SE3(D.rigid.rotation(), Eigen::Vector3d::Zero()).log().tail<3>(),
      std::log(D.scale);
  return xi;
}

// d xi / d eta of those three factors of exp(eta) D.
Matrix7d factored_jacobian(const Sim3& D, const Vector7d& xi) {
  Vector7d turn = Vector7d::Zero();
  turn.segment<3>(3) = xi.segment<3>(3);
  Matrix7d J = Matrix7d::Identity();
  J.block<3, 3>(0, 3) = -skew(D.rigid.translation());
  J.topRightCorner<3, 1>() = D.rigid.translation();
  J.block<3, 3>(3, 3) = sim3_left_jacobian_inverse(turn).block<3, 3>(3, 3);
  return J;
}

}  // namespace

bool has_exact_scale(const Constraint& constraint) { return constraint.covariance(6, 6) == 0; }

bool is_measured(const Constraint& constraint, int direction) {
  return std::isfinite(constraint.covariance(direction, direction));
}

Vector7d graph_error(const Constraint& c, const Sim3& T_world_from, const Sim3& T_world_to) {
  const Sim3 predicted = shifted(T_world_from.inverse() * T_world_to, -c.centre);
  return coordinates(c, predicted * shifted(c.T_from_to, -c.centre).inverse());
}

// With P' = C^-1 P and M' = C^-1 M, D = P' M'^-1, and
//     to:    P' exp(d) M'^-1       = exp(Ad(P') d) D
//     from:  C^-1 exp(-d) P M'^-1  = exp(-Ad(C^-1) d) D
GraphResidual graph_residual(const Constraint& c, const Sim3& T_world_from, const Sim3& T_world_to) {
  const Sim3 predicted = shifted(T_world_from.inverse() * T_world_to, -c.centre);
  const Sim3 D = predicted * shifted(c.T_from_to, -c.centre).inverse();
  GraphResidual r;
  r.xi = coordinates(c, D);
  const Matrix7d J = measures_all(c) ? sim3_left_jacobian_inverse(r.xi) : factored_jacobian(D, r.xi);
  r.J_to = J * predicted.adjoint();
  r.J_from = -J * shifted(Sim3(), -c.centre).adjoint();
  return r;
}

std::vector<GraphMode> graph_modes(const Constraint& c) {
  const std::vector<int> directions = weighted_directions(c);
  if (!c.failure) return {mode_of(c.covariance, directions, 1)};
  return {mode_of(c.covariance, directions, 1 - c.failure->probability),
          mode_of(c.failure->covariance, directions, c.failure->probability)};
}

}  // namespace edgevo
