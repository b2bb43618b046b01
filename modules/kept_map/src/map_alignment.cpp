// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/kept_map/map_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "edgevo/map/map_log.h"
#include "edgevo/map/run_path.h"
#include "edgevo/places/place_memory.h"

namespace edgevo {
namespace {

constexpr size_t kLeastPlaces = 3;
// Places that the others are compared with: so many of them that a right one is among them.
constexpr size_t kHypotheses = 30;

// At its end a run has one unit.
PlaceStore in_one_unit(PlaceStore places) {
  places.number_epochs({});
  return places;
}

size_t position_of(const PlaceStore& store, NodeId node) {
  const auto& all = store.keyframes();
  const auto at = std::lower_bound(all.begin(), all.end(), node.number(),
                                   [](const StoredKeyframe& k, int id) { return k.id < id; });
  return size_t(at - all.begin());
}

// ---- which places agree ----

// Metres over metres: how far the units may differ. Infinite where one of them is unknown.
double unit_sigma(const KeptMap& a, const KeptMap& b) {
  const bool is_known = a.is_metric() && b.is_metric() && a.scale_sigma > 0 && b.scale_sigma > 0;
  return is_known ? std::hypot(a.scale_sigma, b.scale_sigma) : std::numeric_limits<double>::infinity();
}

// What both maps say of the unit, as a measurement of scale 1.
StatedPlace with_unit(StatedPlace place, double sigma) {
  if (std::isinf(sigma)) return place;
  const Vector7d gain = place.covariance.col(6) / (place.covariance(6, 6) + sigma * sigma);
  place.covariance -= (gain * place.covariance.row(6)).eval();
  place.T_place_query = Sim3::exp(-std::log(place.T_place_query.scale) * gain) * place.T_place_query;
  return place;
}

// The most that one of them agrees with.
std::vector<StatedPlace> agreeing(const std::vector<StatedPlace>& all, const PlaceStore& a,
                                  const PlaceStore& b) {
  std::vector<StatedPlace> most;
  const size_t step = std::max<size_t>(1, all.size() / kHypotheses);
  for (size_t i = 0; i < all.size(); i += step) {
    std::vector<StatedPlace> with;
    std::copy_if(all.begin(), all.end(), std::back_inserter(with),
                 [&](const StatedPlace& p) { return agree(all[i], p, a, b); });
    if (with.size() > most.size()) most = std::move(with);
  }
  return most;
}

bool are_enough(const std::vector<StatedPlace>& places) {
  std::set<size_t> queries;
  for (const StatedPlace& p : places) queries.insert(p.query);
  return queries.size() >= kLeastPlaces;
}

// ---- the second map as a run in the first ----

bool is_place_to_hold(const Constraint& c) {
  return c.kind == ConstraintKind::kPlace && c.covariance.allFinite() &&
         Eigen::LLT<Matrix7d>(c.covariance).info() == Eigen::Success;
}

RunPath path_of(const KeptMap& map) {
  RunPath path;
  int segment = -1;
  for (const StoredKeyframe& k : map.store.keyframes()) {
    if (k.record->segment != segment) {
      SegmentPlaced began;
      began.segment = segment = k.record->segment;
      path.epochs.begin_segment(began, Sim3());
    }
    path.marginalised[k.id] = {k.id, segment, k.record->frame_index, k.record->T_world_cam};
    if (k.next) path.neighbours[k.id] = *k.next;
  }
  return path;
}

// What its own run has found is in its poses already: these relations hold them as they lie.
void add_own(const KeptMap& map, RunPath* path, int* number) {
  for (const Constraint& own : map.constraints) {
    const auto from = path->find(own.from.number()), to = path->find(own.to.number());
    if (!from || !to || !is_place_to_hold(own)) continue;
    Constraint c = own;
    c.T_from_to = {1, from->T_map_cam.inverse() * to->T_map_cam};
    path->epochs.add({(*number)++, c});
  }
}

}  // namespace

std::vector<StatedPlace> find_places(const KeptMap& a, const KeptMap& b) {
  PlaceParams only_there;
  only_there.loops = false;
  auto log = std::make_shared<MapLog>();
  for (const StoredKeyframe& k : b.store.keyframes()) log->append(KeyframeAdded{k.id, 0, 0});
  PlaceMemory memory(Rectification(b.header.pinhole), log, only_there,
                     std::make_shared<const PlaceStore>(in_one_unit(a.store)));
  std::vector<StatedPlace> found;
  memory.on_found([&](const Constraint& c) {
    found.push_back({position_of(a.store, c.from), position_of(b.store, c.to), c.T_from_to, c.covariance});
  });
  for (const StoredKeyframe& k : b.store.keyframes()) memory.remember(k);
  memory.finish();
  return found;
}

std::optional<MapAlignment> align_maps(const KeptMap& a, const KeptMap& b, std::vector<StatedPlace> places) {
  const PlaceStore in_a = in_one_unit(a.store), in_b = in_one_unit(b.store);
  const double sigma = unit_sigma(a, b) * std::sqrt(double(places.size()));  // said once, not by each
  for (StatedPlace& p : places) p = with_unit(p, sigma);
  places = agreeing(places, in_a, in_b);
  if (!are_enough(places)) return std::nullopt;
  RunPath path = path_of(b);
  for (size_t i = 0; i < places.size(); ++i)
    path.epochs.add({int(i), constraint_in_world(places[i], in_a, in_b)});
  int number = int(places.size());
  add_own(b, &path, &number);
  const PlacedEpochs placed =
      path.epochs.solve_keyframes(path.run_so_far([](int, int) { return 0; }), path.keyframes());
  MapAlignment found;
  for (size_t i = 0; i < places.size(); ++i)
    if (!placed.is_unused(int(i))) found.places.push_back(places[i]);
  if (!are_enough(found.places)) return std::nullopt;
  for (const StoredKeyframe& k : b.store.keyframes())
    found.T_a_b.push_back(placed.T_world_map(k.record->segment, k.id));
  return found;
}

}  // namespace edgevo
