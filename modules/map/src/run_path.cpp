// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/run_path.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace edgevo {
namespace {

KeyframeInMap in_map(const WindowAdjusted::Active& k) {
  return {k.id, k.keyframe.segment, k.keyframe.frame_index, k.keyframe.T_world_cam};
}

}  // namespace

std::optional<KeyframeInMap> RunPath::find(int id) const {
  if (const auto known = marginalised.find(id); known != marginalised.end()) return known->second;
  for (const WindowAdjusted::Active& k : active())
    if (k.id == id) return in_map(k);
  return std::nullopt;
}

std::vector<KeyframeInMap> RunPath::find(int segment, int first, int last) const {
  std::map<int, KeyframeInMap> found;
  for (auto k = marginalised.lower_bound(first); k != marginalised.end() && k->first <= last; ++k)
    if (k->second.segment == segment) found.insert(*k);
  for (const WindowAdjusted::Active& k : active())
    if (k.id >= first && k.id <= last && k.keyframe.segment == segment) found.emplace(k.id, in_map(k));
  std::vector<KeyframeInMap> keyframes;
  for (const auto& [id, keyframe] : found) keyframes.push_back(keyframe);
  return keyframes;
}

const std::vector<WindowAdjusted::Active>& RunPath::active() const {
  static const std::vector<WindowAdjusted::Active> none;
  return window.keyframes ? *window.keyframes : none;
}

// Rounding may leave it without symmetry, or indefinite.
std::optional<Matrix6d> RunPath::covariance_between(int id, int later_id) const {
  const auto known = neighbours.find(id);
  if (known == neighbours.end() || known->second.id != later_id) return std::nullopt;
  const Matrix6d& c = known->second.covariance;
  const Matrix6d symmetric = 0.5 * (c + c.transpose());
  if (!symmetric.allFinite() || Eigen::LLT<Matrix6d>(symmetric).info() != Eigen::Success) return std::nullopt;
  return symmetric;
}

bool RunPath::is_window_in_kept_map() const {
  const std::map<int, Constraint>& all = epochs.constraints();
  return std::any_of(all.begin(), all.end(), [&](const auto& c) {
    const auto is_found = [&](const WindowAdjusted::Active& k) {
      return c.second.to == NodeId::keyframe(k.id) && marginalised.count(k.id) == 0;
    };
    return c.second.from == NodeId::world() && std::any_of(active().begin(), active().end(), is_found);
  });
}

std::vector<KeyframeInMap> RunPath::keyframes() const {
  std::map<int, KeyframeInMap> known = marginalised;
  if (is_window_in_kept_map())
    for (const WindowAdjusted::Active& k : active()) known.emplace(k.id, in_map(k));
  std::vector<KeyframeInMap> all;
  for (const auto& [id, keyframe] : known) all.push_back(keyframe);
  return all;
}

RunSoFar RunPath::run_so_far(std::function<double(int, int)> doubt) const {
  return {[this](int id) { return find(id); },
          [this](int segment, int first, int last) { return find(segment, first, last); },
          [this](int id, int later_id) { return covariance_between(id, later_id); }, std::move(doubt)};
}

}  // namespace edgevo
