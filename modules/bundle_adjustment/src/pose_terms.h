// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Terms of the cost that constrain poses without depths: the prior and the corners. To add one, write a type
// like CornerTerm in residuals/, a member here, and a cost function in the reference solver,
// ceres_solver.cpp.
#include "normal_equations.h"
#include "prior.h"
#include "residuals/corner_residual.h"

namespace edgevo::ba {

/// Keeps references to the problem's prior and corners.
class PoseTerms {
 public:
  PoseTerms(const BaProblem& problem, double huber_width)
      : prior_(problem), corners_(problem.pinhole, problem.corners, huber_width) {}
  bool empty() const { return prior_.empty() && corners_.empty(); }
  /// Adds cost, Hessian and gradient at `poses`.
  void add(const std::vector<SE3>& poses, NormalEquations* equations) const {
    equations->cost += prior_.add(poses, &equations->H, &equations->b);
    equations->cost += corners_.add(poses, &equations->H, &equations->b);
  }
  void add_cost(const std::vector<SE3>& poses, NormalEquations* equations) const {
    if (!prior_.empty()) equations->cost += prior_.cost(prior_.displacement(poses));
    equations->cost += corners_.cost(poses);
  }

 private:
  PriorTerm prior_;
  CornerTerm corners_;
};

}  // namespace edgevo::ba
