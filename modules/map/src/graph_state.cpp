// SPDX-License-Identifier: BSD-3-Clause
#include "graph_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scale_groups.h"

namespace edgevo {
namespace {

// Groups of nodes that are tied in some way; the first node of a group is its root, 0 the world.
class TiedNodes {
 public:
  explicit TiedNodes(size_t nodes) : parent_(nodes) { std::iota(parent_.begin(), parent_.end(), 0); }

  int root(int node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  void tie(int a, int b) {
    const int x = root(a), y = root(b);
    parent_[std::max(x, y)] = std::min(x, y);
  }

 private:
  std::vector<int> parent_;
};

bool measures_pose(const Constraint& c) {
  for (int k = 0; k < 6; ++k)
    if (is_measured(c, k)) return true;
  return false;
}

std::array<double, 7> pose_values(const SE3& T) {
  const Eigen::Vector4d q = T.rotation().coeffs();
  const Eigen::Vector3d& t = T.translation();
  return {q[0], q[1], q[2], q[3], t[0], t[1], t[2]};
}

}  // namespace

GraphState::GraphState(const std::map<NodeId, Sim3>& guesses, const std::map<int, Constraint>& constraints) {
  std::map<NodeId, int> index;
  for (const auto& [id, T] : guesses) {
    index[id] = static_cast<int>(ids.size());
    ids.push_back(id);
    values.poses.push_back(pose_values(T.rigid));
    values.log_scales.push_back(std::log(T.scale));
  }
  ScaleGroups groups;
  TiedNodes all(ids.size()), by_pose(ids.size()), by_scale(ids.size());
  for (const auto& [id, c] : constraints) {
    GraphTerm term{c, id, index.at(c.from), index.at(c.to), graph_modes(c)};
    if (has_exact_scale(c)) groups.tie(c.from, c.to, std::log(c.T_from_to.scale));
    all.tie(term.from, term.to);
    if (measures_pose(c)) by_pose.tie(term.from, term.to);
    if (is_measured(c, 6)) by_scale.tie(term.from, term.to);
    if (term.modes[0].whitening.rows() > 0) terms.push_back(std::move(term));
  }
  const int n = static_cast<int>(ids.size());
  scale_fixed.assign(n, false);
  for (int i = 0; i < n; ++i) {
    const ScaleGroups::Member member = groups.find(ids[i]);
    root.push_back(index.at(member.root));
    offset.push_back(member.offset);
    // A pose that nothing measures is its own root: it stays at its guess.
    pose_fixed.push_back(by_pose.root(i) == i);
    tied.push_back(all.root(i) == 0);
    scale_tied.push_back(by_scale.root(i) == 0);
    if (all.root(i) == i) scale_fixed[root[i]] = true;
  }
}

Sim3 GraphState::node(int i) const {
  const std::array<double, 7>& x = values.poses[i];
  return {std::exp(values.log_scales[root[i]] + offset[i]),
          SE3(Eigen::Quaterniond(x[3], x[0], x[1], x[2]), Eigen::Vector3d(x[4], x[5], x[6]))};
}

}  // namespace edgevo
