// SPDX-License-Identifier: BSD-3-Clause
#include "keyframe_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "edgevo/core/angle.h"
#include "edgevo/core/motion_tolerance.h"
#include "edgevo/map/path_drift.h"
#include "epoch_constraints.h"

namespace edgevo {
namespace {

NodeId node(int keyframe_id) { return NodeId::keyframe(keyframe_id); }

Sim3 T_world_cam(const KeyframeInMap& k, const PlacedEpochs& placed) {
  return placed.T_world_map(k.segment, k.id) * Sim3{1, k.T_map_cam};
}

// A pose of an adjustment that failed must not end the run.
std::vector<KeyframeInMap> sound(std::vector<KeyframeInMap> keyframes) {
  keyframes.erase(std::remove_if(keyframes.begin(), keyframes.end(),
                                 [](const KeyframeInMap& k) { return !k.T_map_cam.is_finite(); }),
                  keyframes.end());
  return keyframes;
}

// As they lie. In a doubt, or between two maps, as uncertain as a motion that is wrong.
Constraint unsure_neighbours(Constraint c, int frames, double scale_sigma) {
  const double length = c.T_from_to.rigid.translation().norm();
  const double tolerances = std::sqrt(double(std::max(1, frames)) / kMotionTolerance.frames);
  c.covariance = covariance_of(std::max(length, kLeastStep), rad(kMotionTolerance.rotation_deg) * tolerances,
                               std::hypot(kUnitDrift, scale_sigma));
  return c;
}

Constraint neighbours(const KeyframeInMap& a, const KeyframeInMap& b, const RunSoFar& run,
                      const PlacedEpochs& placed) {
  Constraint c;
  c.from = node(a.id), c.to = node(b.id);
  c.kind = ConstraintKind::kNeighbour;
  c.T_from_to = T_world_cam(a, placed).inverse() * T_world_cam(b, placed);
  const bool is_sure = a.segment == b.segment && placed.own.count(a.id) + placed.own.count(b.id) == 0 &&
                       placed.find(a.segment, a.id) == placed.find(b.segment, b.id);
  if (!is_sure)
    return unsure_neighbours(c, b.frame_index - a.frame_index, placed.find(b.segment, b.id)->scale_sigma);
  c.covariance = step_covariance(c.T_from_to.rigid, run.covariance_between(a.id, b.id));
  return c;
}

bool is_in_kept_map(const Constraint& c) { return c.from == NodeId::world(); }

// A keyframe that was found in a kept map.
struct FoundKeyframe {
  int id = 0;
  Sim3 T_kept_run;                  // what it states
  Eigen::Vector3d in_kept, in_run;  // where its camera lies
};

std::vector<FoundKeyframe> found_in_kept_map(const std::map<int, Constraint>& constraints,
                                             const std::vector<KeyframeInMap>& keyframes,
                                             const PlacedEpochs& placed) {
  std::vector<FoundKeyframe> found;
  for (const auto& [id, c] : constraints) {
    if (!is_in_kept_map(c) || placed.is_unused(id)) continue;
    const auto k = std::lower_bound(keyframes.begin(), keyframes.end(), c.to.number(),
                                    [](const KeyframeInMap& known, int number) { return known.id < number; });
    if (k == keyframes.end() || k->id != c.to.number()) continue;
    const Sim3 T_run_cam = T_world_cam(*k, placed);
    found.push_back({k->id, c.T_from_to * T_run_cam.inverse(), c.T_from_to.rigid.translation(),
                     T_run_cam.rigid.translation()});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const FoundKeyframe& a, const FoundKeyframe& b) { return a.id < b.id; });
  return found;
}

// From the world of the run to that of a kept map, a guess by the keyframe found nearest on the path: of
// those next to it the one that explains the places of all of them best, as a median does.
Sim3 into_kept_map(const std::vector<FoundKeyframe>& found, int id) {
  constexpr std::ptrdiff_t kNext = 2;
  if (found.empty()) return {};
  auto at = std::lower_bound(found.begin(), found.end(), id,
                             [](const FoundKeyframe& f, int number) { return f.id < number; });
  if (at == found.end() || (at != found.begin() && id - std::prev(at)->id < at->id - id)) --at;
  const auto begin = at - std::min(kNext, at - found.begin()),
             end = at + std::min(kNext + 1, found.end() - at);
  const auto off = [&](const FoundKeyframe& f) {
    double sum = 0;
    for (auto g = begin; g != end; ++g) sum += (f.T_kept_run * g->in_run - g->in_kept).norm();
    return sum;
  };
  return std::min_element(begin, end, [&](const auto& f, const auto& g) { return off(f) < off(g); })
      ->T_kept_run;
}

// One that can be mistaken, unless it says how it may fail: then the camera is anywhere within the `extent`
// of the map.
Constraint place(const Constraint& given, double extent) {
  Constraint c = with_uncertain_scale(given);
  if (!c.failure) c.failure = mistaken(c.covariance, {extent, kUnknownRotation});
  return c;
}

// Length of the diagonal of the box around the nodes and what is stated of a kept map.
double extent_of(const std::map<NodeId, Sim3>& nodes, const std::map<int, Constraint>& constraints) {
  Eigen::AlignedBox3d box;
  for (const auto& [id, T_world_node] : nodes) box.extend(T_world_node.rigid.translation());
  for (const auto& [id, c] : constraints)
    if (is_in_kept_map(c)) box.extend(c.T_from_to.rigid.translation());
  return box.diagonal().norm();
}

// What follows the newest keyframe moves with it.
void move_epochs_after(const KeyframeInMap& newest, const Sim3& T_after_before, PlacedEpochs* placed) {
  const EpochPlace* of_newest = placed->find(newest.segment, newest.id);
  bool is_after = false;
  for (EpochPlace& e : placed->epochs) {
    if (is_after) e.T_world_map = T_after_before * e.T_world_map;
    if (&e != of_newest) continue;
    e.T_world_map = placed->own.at(newest.id);
    is_after = true;
  }
}

// The epoch of a keyframe that is found in a kept map has its unit.
void know_unit(const Constraint& c, const std::vector<KeyframeInMap>& keyframes, PlacedEpochs* placed) {
  const auto k = std::find_if(keyframes.begin(), keyframes.end(),
                              [&](const KeyframeInMap& known) { return known.id == c.to.number(); });
  const EpochPlace* found = placed->find(k->segment, k->id);
  for (EpochPlace& e : placed->epochs)
    if (&e == found) e.scale_sigma = std::min(e.scale_sigma, std::sqrt(c.covariance(6, 6)));
}

// Returns whether a kept map holds the run, if one is stated to.
bool place(const std::map<int, Constraint>& constraints, const std::vector<KeyframeInMap>& keyframes,
           const RunSoFar& run, PlacedEpochs* placed) {
  MapGraph graph;
  const std::vector<FoundKeyframe> found_keyframes = found_in_kept_map(constraints, keyframes, *placed);
  for (const KeyframeInMap& k : keyframes)
    graph.add_node(node(k.id), into_kept_map(found_keyframes, k.id) * T_world_cam(k, *placed));
  for (size_t i = 1; i < keyframes.size(); ++i)
    graph.add(neighbours(keyframes[i - 1], keyframes[i], run, *placed));
  const double extent = extent_of(graph.nodes(), constraints);
  std::map<int, int> id_of;  // by number in the graph
  int in_kept_map = 0;
  for (const auto& [id, c] : constraints)
    if (measures_place(c) && !placed->is_unused(id) && graph.knows(c.from) && graph.knows(c.to))
      id_of[graph.add(place(c, extent))] = id, in_kept_map += is_in_kept_map(c);
  const GraphSolution found = graph.solve(MapGraph::Sigmas::kNone);
  const bool is_held_by_one = in_kept_map > 0;
  for (const int failed : found.failed)
    if (const auto c = id_of.find(failed); c != id_of.end()) {
      placed->unused.push_back(c->second);
      in_kept_map -= is_in_kept_map(constraints.at(c->second));
    }
  if (is_held_by_one && in_kept_map == 0) return false;
  const KeyframeInMap& newest = keyframes.back();
  const Sim3 before = T_world_cam(newest, *placed);
  for (const KeyframeInMap& k : keyframes)
    placed->own[k.id] = found.nodes.at(node(k.id)).T_world_node * Sim3{1, k.T_map_cam}.inverse();
  for (const auto& [id, number] : id_of)
    if (is_in_kept_map(constraints.at(number)) && !placed->is_unused(number))
      know_unit(constraints.at(number), keyframes, placed);
  move_epochs_after(newest, T_world_cam(newest, *placed) * before.inverse(), placed);
  return true;
}

}  // namespace

// Features link the ends of a doubt: within one epoch they show what tracking had.
bool relates_keyframes(const Constraint& c, const RunSoFar& run) {
  if (is_in_kept_map(c)) return measures_place(c) && run.keyframe(c.to.number());
  return measures_place(c) && c.kind != ConstraintKind::kFeatures && run.keyframe(c.from.number()) &&
         run.keyframe(c.to.number());
}

void place_keyframes(const std::map<int, Constraint>& constraints, const std::vector<KeyframeInMap>& known,
                     const RunSoFar& run, PlacedEpochs* placed) {
  const std::vector<KeyframeInMap> keyframes = sound(known);
  if (keyframes.empty() || place(constraints, keyframes, run, placed)) return;
  // All that was found in a kept map is contradicted: the run keeps its own frame and unit.
  place(constraints, keyframes, run, placed);
}

}  // namespace edgevo
