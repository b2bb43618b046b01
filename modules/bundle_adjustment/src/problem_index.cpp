// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/bundle_adjustment/problem_index.h"

namespace edgevo::ba {

ProblemIndex index_problem(const BaProblem& problem) {
  ProblemIndex index;
  std::vector<int>& of_host = index.first_of_host;
  of_host.assign(problem.poses.size() + 1, 0);
  for (const BaPoint& p : problem.points) ++of_host[p.host + 1];
  for (std::size_t h = 1; h < of_host.size(); ++h) of_host[h] += of_host[h - 1];
  std::vector<int> next = of_host;
  index.points.resize(problem.points.size());
  for (std::size_t i = 0; i < problem.points.size(); ++i)
    index.points[next[problem.points[i].host]++] = static_cast<int>(i);

  std::vector<int>& of_point = index.first_observation;
  of_point.assign(problem.points.size() + 1, 0);
  for (const BaObservation& o : problem.observations) ++of_point[o.point + 1];
  for (std::size_t i = 1; i < of_point.size(); ++i) of_point[i] += of_point[i - 1];
  return index;
}

BaProblem problem_of_host(const BaProblem& problem, const ProblemIndex& index, int host, int end) {
  const auto has = [&](int pose) { return pose >= host && pose < end; };
  BaProblem part;
  part.pinhole = problem.pinhole;
  part.poses.assign(problem.poses.begin() + host, problem.poses.begin() + end);
  part.pose_ids.assign(problem.pose_ids.begin() + host, problem.pose_ids.begin() + end);
  for (int n = index.first_of_host[host]; n < index.first_of_host[host + 1]; ++n) {
    const int i = index.points[n], at = static_cast<int>(part.points.size());
    const std::size_t before = part.observations.size();
    for (int k = index.first_observation[i]; k < index.first_observation[i + 1]; ++k) {
      BaObservation o = problem.observations[k];
      if (!has(o.target)) continue;
      o.point = at;
      o.target -= host;
      part.observations.push_back(o);
    }
    if (part.observations.size() == before) continue;
    part.points.push_back(problem.points[i]);
    part.points.back().host = 0;
  }
  for (BaCornerPair c : problem.corners) {
    if (!has(c.from) || !has(c.to)) continue;
    c.from -= host;
    c.to -= host;
    part.corners.push_back(c);
  }
  for (BaTurn t : problem.turns) {
    if (!has(t.from) || !has(t.to)) continue;
    t.from -= host;
    t.to -= host;
    part.turns.push_back(t);
  }
  return part;
}

}  // namespace edgevo::ba
