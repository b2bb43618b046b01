// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/kept_map/map_extension.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/order_statistics.h"
#include "renumbered_map.h"

namespace edgevo {
namespace {

// ---- the same view ----

// Share of what a keyframe shows that lies in the view of another one.
double share_in_view(const Pinhole& pinhole, const KeyframeRecord& from, const KeyframeRecord& to) {
  const SE3 T_to_from = to.T_world_cam.inverse() * from.T_world_cam;
  const Eigen::Matrix3d R = T_to_from.R();
  int seen = 0;
  for (const EdgePoint& p : from.points) {
    const Projection there =
        project(pinhole, R, T_to_from.translation(), pinhole.ray(p.px.cast<double>()), p.idepth);
    seen += there.valid && pinhole.contains(there.px, 0);
  }
  return double(seen) / double(std::max<size_t>(from.points.size(), 1));
}

bool look_the_same_way(const KeyframeRecord& a, const KeyframeRecord& b) {
  return a.T_world_cam.R().col(2).dot(b.T_world_cam.R().col(2)) > 0;
}

bool show_the_same(const Pinhole& pinhole, const KeyframeRecord& a, const KeyframeRecord& b) {
  constexpr double kHalf = 0.5;
  return look_the_same_way(a, b) && share_in_view(pinhole, a, b) >= kHalf &&
         share_in_view(pinhole, b, a) >= kHalf;
}

// ---- the same light ----

// How alike the light of keyframes is that follow one another.
class LightSpread {
 public:
  explicit LightSpread(const PlaceStore& store) {
    std::vector<double> means{kLeast}, contrasts{kLeast};
    for (size_t i = 1; i < store.size(); ++i) {
      const StoredKeyframe &a = store.keyframes()[i - 1], &b = store.keyframes()[i];
      if (a.record->segment != b.record->segment) continue;
      means.push_back(std::abs(a.view->light.mean - b.view->light.mean));
      contrasts.push_back(std::abs(a.view->light.contrast - b.view->light.contrast));
    }
    mean_ = sigma_of(std::move(means)), contrast_ = sigma_of(std::move(contrasts));
  }

  bool is_the_same(const ViewLight& a, const ViewLight& b) const {
    constexpr double kSigmas = 3;
    return std::abs(a.mean - b.mean) < kSigmas * mean_ &&
           std::abs(a.contrast - b.contrast) < kSigmas * contrast_;
  }

 private:
  static constexpr double kLeast = 1;  // gray levels, of a still camera

  static double sigma_of(std::vector<double> differences) {
    constexpr double kPerMedian = 1.4826;
    return std::max(kLeast, kPerMedian * median(std::move(differences)));
  }

  double mean_ = kLeast, contrast_ = kLeast;
};

// ---- what is new ----

std::set<int> segments_of(const PlaceStore& store, const std::set<int>& ids) {
  std::set<int> segments;
  for (const StoredKeyframe& k : store.keyframes())
    if (ids.count(k.id) > 0) segments.insert(k.record->segment);
  return segments;
}

std::set<int> ends_of(const std::vector<Constraint>& constraints) {
  std::set<int> ids;
  for (const Constraint& c : constraints) ids.insert(c.to.number());
  return ids;
}

// One without points, at the end of a run, shows nothing that is placed.
bool is_new(const PlaceStore& map, const LightSpread& light, const StoredKeyframe& keyframe) {
  if (keyframe.record->points.empty()) return false;
  std::set<int> sessions;
  for (const StoredKeyframe& record : map.keyframes()) {
    if (!show_the_same(map.pinhole(), *record.record, *keyframe.record)) continue;
    sessions.insert(record.record->segment);
    if (light.is_the_same(record.view->light, keyframe.view->light)) return false;
  }
  return int(sessions.size()) < kRecordsOfPlace;
}

}  // namespace

std::vector<size_t> new_views(const KeptMap& map, const KeptMap& run, const std::vector<Constraint>& found) {
  const std::set<int> placed = segments_of(run.store, ends_of(found));
  const LightSpread light(map.store);
  std::vector<size_t> fresh;
  for (size_t i = 0; i < run.store.size(); ++i) {
    const StoredKeyframe& k = run.store.keyframes()[i];
    if (placed.count(k.record->segment) > 0 && is_new(map.store, light, k)) fresh.push_back(i);
  }
  return fresh;
}

size_t extend_map(const KeptMap& run, const std::vector<Constraint>& found, KeptMap* map) {
  KeptMap added(run.header);
  for (const size_t i : new_views(*map, run, found)) added.store.add(run.store.keyframes()[i]);
  added.constraints = run.constraints;
  Numbers of_map;
  for (const StoredKeyframe& k : map->store.keyframes()) of_map[k.id] = k.id;
  const Numbers of_added = append(added, map);
  for (const Constraint& c : found) {
    if (of_map.count(c.from.number()) == 0 || of_added.count(c.to.number()) == 0) continue;
    map->constraints.push_back(renumbered(c, of_map, of_added));
    map->constraints.back().T_from_to.scale = 1;  // the run has the unit of the map
  }
  return added.store.size();
}

}  // namespace edgevo
