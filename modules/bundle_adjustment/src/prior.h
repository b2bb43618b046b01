// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The marginalisation prior as a term of the cost, and the Jacobians of SE(3)'s exponential that it needs.
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// Left Jacobian J_l, with exp(xi + x) = exp(J_l(xi) x) exp(xi) to first order in x. Tangents [v, w].
Matrix6d left_jacobian(const Vector6d& xi);

/// BaProblem::prior bound to the poses of its problem; empty without a prior. Keeps a reference to the
/// problem.
class PriorTerm {
 public:
  explicit PriorTerm(const BaProblem& problem);
  bool empty() const { return pose_index_.empty(); }
  /// Index into BaProblem::poses of each pose of the prior.
  const std::vector<int>& pose_index() const { return pose_index_; }
  /// Displacement xi of all poses of the prior, 6n.
  Eigen::VectorXd displacement(const std::vector<SE3>& poses) const;
  double cost(const Eigen::VectorXd& xi) const;
  /// Adds the term's Hessian and gradient by left perturbations of `poses` to H and b (6 rows a pose);
  /// returns the cost.
  double add(const std::vector<SE3>& poses, Eigen::MatrixXd* H, Eigen::VectorXd* b) const;

 private:
  const BaProblem& problem_;
  std::vector<int> pose_index_;
};

}  // namespace edgevo::ba
