// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_memory.h"

#include <algorithm>

namespace edgevo {
namespace {

// Keyframes closer than this are still in the window, or show what the window has seen.
constexpr size_t kLeastGap = 30;
constexpr size_t kCandidates = 3;
// A place is believed if so many of the last queries agree.
constexpr size_t kAgreeing = 3, kRecent = 6;
// Squared Mahalanobis distance of seven directions that is exceeded once in 370 times: three sigmas.
constexpr double kThreeSigmas = 21.8;

double squared_distance(const Sim3& measured, const Sim3& expected, const Matrix7d& covariance) {
  const Vector7d off = (measured * expected.inverse()).log();
  return off.dot(covariance.ldlt().solve(off));
}

Matrix7d moved(const Sim3& T, const Matrix7d& covariance) {
  const Matrix7d A = T.adjoint();
  return A * covariance * A.transpose();
}

}  // namespace

PlaceMemory::PlaceMemory(const Rectification& rectification, std::shared_ptr<MapLog> log)
    : rectification_(rectification), log_(std::move(log)), store_(rectification.target()) {}

void PlaceMemory::apply(const MapEvent& event) {
  std::visit([this](const auto& e) { handle(e); }, event);
}

void PlaceMemory::handle(const SegmentPlaced&) {
  first_of_epoch_.push_back(store_.size() == 0 ? 0 : store_.keyframes().back().id + 1);
}

void PlaceMemory::handle(const EpochBegan& e) { first_of_epoch_.push_back(e.first); }

void PlaceMemory::handle(const KeyframeMarginalised& e) {
  StoredKeyframe k{e.id, 0, e.keyframe, nullptr, std::nullopt};
  const auto after = std::upper_bound(first_of_epoch_.begin(), first_of_epoch_.end(), e.id);
  k.epoch = int(after - first_of_epoch_.begin());
  if (!e.neighbours.empty()) k.next = e.neighbours.front();
  if (e.pyramid && !e.keyframe->is_doubtful) {
    k.view = std::make_shared<const RememberedView>(remember_view(*e.pyramid));
    index_.add(*k.view);
    keyframe_of_.push_back(store_.size());
  }
  on_stored_(k);
  store_.add(std::move(k));
  if (looks_up_ && store_.size() > PlaceStore::kAround) look_up(store_.size() - 1 - PlaceStore::kAround);
}

void PlaceMemory::handle(const MapMoved& e) {
  store_.move(rectification_, e);
  if (!e.lens) return;
  for (const StoredKeyframe& k : store_.keyframes())
    if (k.record->segment == e.segment && e.find(k.id)) on_stored_(k);
}

// Number of the views that are far enough before a keyframe.
size_t PlaceMemory::end_of_places(size_t query) const {
  size_t end = 0;
  while (end < keyframe_of_.size()) {
    const size_t at = keyframe_of_[end];
    if (at >= query || (store_.is_one_unit(at, query) && at + kLeastGap > query)) break;
    ++end;
  }
  return end;
}

void PlaceMemory::look_up(size_t query) {
  const StoredKeyframe& k = store_.keyframes()[query];
  if (!k.view) return;
  ++counts_.queries;
  const std::vector<int> views = index_.candidates(*k.view, int(end_of_places(query)), kCandidates);
  counts_.candidates += int(views.size());
  believe(prove(query, views));
}

std::vector<PlaceMemory::Proved> PlaceMemory::prove(size_t query, const std::vector<int>& views) {
  std::vector<Proved> proved;
  const PlaceView b{*store_.keyframes()[query].view, store_.points_around(query)};
  for (const int view : views) {
    const size_t place = keyframe_of_[size_t(view)];
    const PlaceView a{*store_.keyframes()[place].view, store_.points_around(place)};
    const std::optional<PlaceMatch> match = match_views(store_.pinhole(), a, b);
    if (!match) continue;
    ++counts_.proved;
    proved.push_back({place, query, *match, false});
  }
  return proved;
}

// Whether the path between the two, as far as it may be off, allows the place.
bool PlaceMemory::is_on_path(const Proved& p) const {
  if (!store_.is_one_unit(p.place, p.query)) return true;
  const Sim3 by_path{1, store_.T_a_b(p.place, p.query)};
  return squared_distance(p.match.T_a_b, by_path,
                          store_.path_covariance(p.place, p.query) + p.match.covariance) < kThreeSigmas;
}

// Whether the way over place and query of one is that of the other: T_a_b of one, as the other has it.
bool PlaceMemory::agree(const Proved& a, const Proved& b) const {
  if (!store_.is_one_unit(a.place, b.place) || !store_.is_one_unit(a.query, b.query)) return false;
  const Sim3 to_place{1, store_.T_a_b(a.place, b.place)}, from_query{1, store_.T_a_b(b.query, a.query)};
  const Sim3 to_query_by_b = to_place * b.match.T_a_b;
  const Matrix7d covariance = a.match.covariance + store_.path_covariance(a.place, b.place) +
                              moved(to_place, b.match.covariance) +
                              moved(to_query_by_b, store_.path_covariance(b.query, a.query));
  return squared_distance(a.match.T_a_b, to_query_by_b * from_query, covariance) < kThreeSigmas;
}

// Whether one keyframe, which both match, cannot be in both places.
bool PlaceMemory::are_apart(const Proved& a, const Proved& b) const {
  return store_.is_one_unit(a.place, b.place) && !agree(a, b);
}

// Those that the path allows; none if they are places apart, which look alike.
std::vector<PlaceMemory::Proved> PlaceMemory::possible(std::vector<Proved> found) {
  const auto end =
      std::remove_if(found.begin(), found.end(), [this](const Proved& p) { return !is_on_path(p); });
  counts_.beyond_drift += int(found.end() - end);
  found.erase(end, found.end());
  const auto is_apart = [&](const Proved& p) { return are_apart(found.front(), p); };
  if (found.empty() || std::none_of(found.begin() + 1, found.end(), is_apart)) return found;
  counts_.ambiguous += int(found.size());
  return {};
}

void PlaceMemory::believe(std::vector<Proved> found) {
  recent_.push_back(possible(std::move(found)));
  if (recent_.size() > kRecent) recent_.pop_front();
  for (Proved& p : recent_.back()) {
    const std::vector<Proved*> agreeing = agreeing_with(&p);
    if (agreeing.size() >= kAgreeing)
      for (Proved* a : agreeing) state(a);
  }
}

// A place of the newest keyframe and those of keyframes before it, one of each, that agree with it.
std::vector<PlaceMemory::Proved*> PlaceMemory::agreeing_with(Proved* newest) {
  std::vector<Proved*> agreeing{newest};
  for (size_t i = 0; i + 1 < recent_.size(); ++i) {
    const auto found = std::find_if(recent_[i].begin(), recent_[i].end(),
                                    [&](const Proved& before) { return agree(before, *newest); });
    if (found != recent_[i].end()) agreeing.push_back(&*found);
  }
  return agreeing;
}

void PlaceMemory::state(Proved* p) {
  if (p->is_stated) return;
  p->is_stated = true;
  Constraint c;
  c.from = NodeId::keyframe(store_.keyframes()[p->place].id);
  c.to = NodeId::keyframe(store_.keyframes()[p->query].id);
  c.T_from_to = p->match.T_a_b;
  c.covariance = p->match.covariance;
  c.kind = ConstraintKind::kPlace;
  log_->add_constraint(c);
  ++counts_.stated;
}

}  // namespace edgevo
