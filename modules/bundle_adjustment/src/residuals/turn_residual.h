// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rotations between two keyframes that another sensor measured, as a term of the cost.
//
// With R_to_from of the poses and M as measured, the residual is w = log(R_to_from M^-1), weighted by the
// inverse of its covariance. Derivative for the left perturbation [v, w] of T_to_world, to first order in the
// residual: [0 | I], for T_from_world the same times -Ad(T_to_from).
#include <Eigen/Core>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// Rotation of the poses beyond the measured one.
Eigen::Vector3d turn_residual(const SE3& T_to_from, const BaTurn& turn);

/// BaProblem::turns under Huber's loss on the length in sigmas. Keeps a reference to them.
class TurnTerm {
 public:
  TurnTerm(const std::vector<BaTurn>& turns, double huber_width) : turns_(turns), huber_width_(huber_width) {}
  bool empty() const { return turns_.empty(); }
  double cost(const std::vector<SE3>& poses) const;
  /// As CornerTerm::add().
  double add(const std::vector<SE3>& poses, Eigen::MatrixXd* H, Eigen::VectorXd* b) const;

 private:
  const std::vector<BaTurn>& turns_;
  double huber_width_;
};

}  // namespace edgevo::ba
