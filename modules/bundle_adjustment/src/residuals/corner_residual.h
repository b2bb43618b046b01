// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Corners seen in two keyframes as a term of the cost: the constraint of two views of a point without depth
// on their poses.
//
// With rays x and y, T_to_from = (R, t), the line l = t x R x of x in the second view and l' = R^T (y x t) of
// y in the first, the residual is the distance of both rays from their lines, to first order (Sampson):
//     r = f y^T l / (sigma |(l_1, l_2, l'_1, l'_2)|)
// It does not depend on the length of t. Derivative for the left perturbation [v, w] of T_to_world, the
// denominator fixed during a step:
//     f / (sigma |..|) [R x  x  y | l  x  y],   for T_from_world the same times -Ad(T_to_from).
#include <Eigen/Core>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

struct CornerLinearization {
  /// Whitened residual.
  double residual = 0;
  /// Derivative by the pose `to`; that by `from` is -Ad(T_to_from)^T J_to.
  Vector6d J_to = Vector6d::Zero();
};
CornerLinearization linearize(const Pinhole& pinhole, const SE3& T_to_from, const BaCornerPair& pair);

/// BaProblem::corners under Huber's loss. Keeps a reference to them.
class CornerTerm {
 public:
  CornerTerm(const Pinhole& pinhole, const std::vector<BaCornerPair>& pairs, double huber_width)
      : pinhole_(pinhole), pairs_(pairs), huber_width_(huber_width) {}
  bool empty() const { return pairs_.empty(); }
  double cost(const std::vector<SE3>& poses) const;
  /// Adds the term's Hessian and gradient by left perturbations of `poses` to H and b (6 rows a pose);
  /// returns the cost.
  double add(const std::vector<SE3>& poses, Eigen::MatrixXd* H, Eigen::VectorXd* b) const;

 private:
  const Pinhole& pinhole_;
  const std::vector<BaCornerPair>& pairs_;
  double huber_width_;
};

}  // namespace edgevo::ba
