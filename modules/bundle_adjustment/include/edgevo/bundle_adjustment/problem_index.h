// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Index of a BaProblem by host, and the part of it that belongs to one host, for marginalising keyframes: the
// oldest of a window, or one after the other in a long history.
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// Points of each host and observations of each point. Cost: linear in the problem.
struct ProblemIndex {
  /// Indices into BaProblem::points, host by host, ascending within each.
  std::vector<int> points;
  /// Host h has the points [first_of_host[h], first_of_host[h + 1]) of `points`.
  std::vector<int> first_of_host;
  /// Point i has observations [first_observation[i], first_observation[i + 1]).
  std::vector<int> first_observation;
};
/// Indexes a problem, whose observations of a point must be adjacent.
ProblemIndex index_problem(const BaProblem& problem);

/// Part of a problem with the poses [host, end), the points hosted by `host`, and the matches and corners
/// among these poses; without a prior and without points that have no match. Cost: linear in the part.
BaProblem problem_of_host(const BaProblem& problem, const ProblemIndex& index, int host, int end);

}  // namespace edgevo::ba
