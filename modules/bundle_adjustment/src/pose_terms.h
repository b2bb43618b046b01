// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Terms of the cost that constrain poses without depths: the prior, corners, and turns. To add one, write a
// type like CornerTerm in residuals/, a member here, and a cost function in the reference solver,
// ceres_solver.cpp.
#include "normal_equations.h"
#include "prior.h"
#include "residuals/corner_residual.h"
#include "residuals/turn_residual.h"

namespace edgevo::ba {

/// Keeps references to the problem's prior, corners and turns.
class PoseTerms {
 public:
  PoseTerms(const BaProblem& problem, double huber_width)
      : prior_(problem),
        corners_(problem.pinhole, problem.corners, huber_width),
        turns_(problem.turns, huber_width) {}
  bool empty() const { return prior_.empty() && corners_.empty() && turns_.empty(); }
  /// Adds cost, Hessian and gradient at `poses`.
  void add(const std::vector<SE3>& poses, NormalEquations* equations) const {
    equations->cost += prior_.add(poses, &equations->H, &equations->b);
    equations->cost += corners_.add(poses, &equations->H, &equations->b);
    equations->cost += turns_.add(poses, &equations->H, &equations->b);
  }
  void add_cost(const std::vector<SE3>& poses, NormalEquations* equations) const {
    if (!prior_.empty()) equations->cost += prior_.cost(prior_.displacement(poses));
    equations->cost += corners_.cost(poses);
    equations->cost += turns_.cost(poses);
  }

 private:
  PriorTerm prior_;
  CornerTerm corners_;
  TurnTerm turns_;
};

}  // namespace edgevo::ba
