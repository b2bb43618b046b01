#pragma once
// A BaProblem by host, and the part of it that concerns one host: what marginalising a keyframe takes, a
// window's oldest or one of a long history after another.
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// Where the points of each host and the observations of each point are. Cost: one pass over the problem.
struct ProblemIndex {
  /// Indices into BaProblem::points, host by host, ascending within each.
  std::vector<int> points;
  /// Host h has points[first_of_host[h]] to before points[first_of_host[h + 1]].
  std::vector<int> first_of_host;
  /// Point i has observations [first_observation[i], first_observation[i + 1]).
  std::vector<int> first_observation;
};
/// Observations of a point must be adjacent, as in BaProblem.
ProblemIndex index_problem(const BaProblem& problem);

/// The poses [host, end) of a problem with the points that `host` hosts, matches and corners among these
/// poses, and no prior. Points that are left without a match are left out. Cost: that of the part.
BaProblem problem_of_host(const BaProblem& problem, const ProblemIndex& index, int host, int end);

}  // namespace edgevo::ba
