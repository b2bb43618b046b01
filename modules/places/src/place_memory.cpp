// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_memory.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <iterator>

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

Matrix7d symmetric(const Matrix7d& m) { return 0.5 * (m + m.transpose()); }

}  // namespace

void PlaceMemory::Known::add(const StoredKeyframe& keyframe, size_t position) {
  if (!keyframe.view) return;
  index.add(*keyframe.view);
  keyframe_of.push_back(position);
}

PlaceMemory::PlaceMemory(const Rectification& rectification, std::shared_ptr<MapLog> log,
                         const PlaceParams& params, std::shared_ptr<const PlaceStore> kept)
    : rectification_(rectification),
      log_(std::move(log)),
      params_(params),
      kept_store_(std::move(kept)),
      store_(rectification.target()),
      young_(rectification.target()) {
  own_.store = &store_;
  kept_.store = kept_store_.get();
  for (Known* known : {&own_, &kept_}) known->finished.store = &store_, known->young.store = &young_;
  for (size_t i = 0; kept_store_ && i < kept_store_->size(); ++i) kept_.add(kept_store_->keyframes()[i], i);
}

void PlaceMemory::apply(const MapEvent& event) {
  std::visit([this](const auto& e) { handle(e); }, event);
}

// All of the run so far is of other epochs.
void PlaceMemory::handle(const SegmentPlaced& e) {
  if (store_.size() > 0) first_of_epoch_.insert(store_.keyframes().back().id + 1);
  for (; !waiting_.empty(); waiting_.pop_front())
    own_.add(store_.keyframes()[waiting_.front()], waiting_.front());
  young_segment_ = e.segment;
  begin_young();
}

// It can be announced when keyframes of it, or of the next segment, have been stored. Those in the doubt
// belong to neither side.
void PlaceMemory::handle(const EpochBegan& e) {
  first_of_epoch_.insert({e.last_before + 1, e.first});
  store_.number_epochs(first_of_epoch_);
}

void PlaceMemory::handle(const KeyframeMarginalised& e) {
  StoredKeyframe k{e.id, 0, e.keyframe, nullptr, std::nullopt};
  k.epoch = int(std::distance(first_of_epoch_.begin(), first_of_epoch_.upper_bound(e.id)));
  if (!e.neighbours.empty()) k.next = e.neighbours.front();
  if (e.pyramid && !e.keyframe->is_doubtful)
    k.view = std::make_shared<const RememberedView>(remember_view(*e.pyramid));
  if (k.view && params_.loops) waiting_.push_back(store_.size());
  on_stored_(k);
  store_.add(std::move(k));
  if (store_.size() <= PlaceStore::kAround) return;
  if (looks_up_)
    look_up(store_.size() - 1 - PlaceStore::kAround);
  else
    ++counts_.skipped;
}

// ---- keyframes in the window ----

void PlaceMemory::begin_young() {
  young_ = PlaceStore(rectification_.target());
  for (Known* known : {&own_, &kept_}) {
    known->young = {&young_, {}, {}, {}};
    known->is_sought = known->index.size() > 0;
  }
}

void PlaceMemory::handle(const WindowAdjusted& e) {
  if (!looks_up_ || !e.keyframes || !(own_.is_sought || kept_.is_sought)) return;
  const size_t first_new = young_.size();
  for (const WindowAdjusted::Active& k : *e.keyframes) take_young(k);
  for (size_t query = first_new; query < young_.size(); ++query)
    for (Known* known : {&own_, &kept_})
      if (known->is_sought && young_.keyframes()[query].view) look_up(query, known, &known->young);
}

void PlaceMemory::take_young(const WindowAdjusted::Active& active) {
  const std::vector<StoredKeyframe>& all = young_.keyframes();
  const auto same =
      std::find_if(all.begin(), all.end(), [&](const StoredKeyframe& k) { return k.id == active.id; });
  if (same != all.end()) return young_.update(size_t(same - all.begin()), active.keyframe);
  StoredKeyframe k{active.id, 0, std::make_shared<const KeyframeRecord>(active.keyframe), nullptr, {}};
  if (active.pyramid && !active.keyframe.is_doubtful)
    k.view = std::make_shared<const RememberedView>(remember_view(*active.pyramid));
  young_.add(std::move(k));
}

// ---- keyframes that have left it ----

void PlaceMemory::finish() {
  const size_t waiting = std::min(store_.size(), PlaceStore::kAround);
  for (size_t query = store_.size() - waiting; looks_up_ && query < store_.size(); ++query) look_up(query);
}

void PlaceMemory::handle(const MapMoved& e) {
  store_.move(rectification_, e);
  if (!e.lens) return;
  for (const StoredKeyframe& k : store_.keyframes())
    if (k.record->segment == e.segment && e.find(k.id)) on_stored_(k);
}

// Those of the run that are far enough before a keyframe: what was seen around it is no place seen again.
void PlaceMemory::add_places_before(size_t query) {
  const auto is_far = [&](size_t at) {
    return at < query && (!store_.is_one_unit(at, query) || at + kLeastGap <= query);
  };
  for (; !waiting_.empty() && is_far(waiting_.front()); waiting_.pop_front())
    own_.add(store_.keyframes()[waiting_.front()], waiting_.front());
}

void PlaceMemory::look_up(size_t query) {
  add_places_before(query);
  if (!store_.keyframes()[query].view) return;
  ++counts_.queries;
  look_up(query, &own_, &own_.finished);
  if (kept_.store) look_up(query, &kept_, &kept_.finished);
}

// States the place of the newest keyframe that is proved best, and those of keyframes before it that agree.
void PlaceMemory::look_up(size_t query, Known* known, Row* row) {
  const std::vector<int> views =
      known->index.candidates(*row->store->keyframes()[query].view, kCandidates, &row->votes);
  counts_.candidates += int(views.size());
  row->recent.push_back(possible(prove(query, views, *known, *row), *known, *row));
  if (row->recent.size() > kRecent) row->recent.pop_front();
  std::vector<Proved>& newest = row->recent.back();
  if (newest.empty()) return;
  const std::vector<Proved*> agreeing = agreeing_with(&newest.front(), *known, row);
  if (agreeing.size() >= kAgreeing)
    for (Proved* p : agreeing) state(p, known, row);
}

std::vector<PlaceMemory::Proved> PlaceMemory::prove(size_t query, const std::vector<int>& views,
                                                    const Known& known, const Row& row) {
  std::vector<Proved> proved;
  const PlaceView b{*row.store->keyframes()[query].view, row.store->points_around(query)};
  for (const int view : views) {
    const size_t place = known.keyframe_of[size_t(view)];
    const PlaceView a{*known.store->keyframes()[place].view, known.store->points_around(place)};
    const std::optional<PlaceMatch> match = match_views(store_.pinhole(), a, b);
    if (!match) continue;
    ++counts_.proved;
    proved.push_back({place, query, *match, false});
  }
  std::stable_sort(proved.begin(), proved.end(), [](const Proved& a, const Proved& b) {
    return a.match.evidence.edges_log_alarms < b.match.evidence.edges_log_alarms;
  });
  return proved;
}

// Whether the path between the two, as far as it may be off, allows the place.
bool PlaceMemory::is_on_path(const Proved& p) const {
  if (!store_.is_one_unit(p.place, p.query)) return true;
  const Sim3 by_path{1, store_.T_a_b(p.place, p.query)};
  return squared_distance(p.match.T_a_b, by_path,
                          store_.path_covariance(p.place, p.query) + p.match.covariance) < kThreeSigmas;
}

// Whether the path between the two is more certain than what their views show: at a standstill, or at a desk.
bool PlaceMemory::is_known_already(const Proved& p) const {
  return store_.is_one_unit(p.place, p.query) &&
         store_.path_covariance(p.place, p.query).trace() < p.match.covariance.trace();
}

// Whether the way over place and query of one is that of the other: T_a_b of one, as the other has it.
bool PlaceMemory::agree(const Proved& a, const Proved& b, const Known& known, const Row& row) {
  const PlaceStore &places = *known.store, &queries = *row.store;
  if (!places.is_one_unit(a.place, b.place) || !queries.is_one_unit(a.query, b.query)) return false;
  const Sim3 to_place{1, places.T_a_b(a.place, b.place)}, from_query{1, queries.T_a_b(b.query, a.query)};
  const Sim3 to_query_by_b = to_place * b.match.T_a_b;
  const Matrix7d covariance = a.match.covariance + places.path_covariance(a.place, b.place) +
                              moved(to_place, b.match.covariance) +
                              moved(to_query_by_b, queries.path_covariance(b.query, a.query));
  return squared_distance(a.match.T_a_b, to_query_by_b * from_query, covariance) < kThreeSigmas;
}

// Those that the path allows; none if they are places apart, which look alike.
std::vector<PlaceMemory::Proved> PlaceMemory::possible(std::vector<Proved> found, const Known& known,
                                                       const Row& row) {
  const auto is_off = [&](const Proved& p) {
    if (&known != &own_) return false;
    return &row == &known.young ? store_.keyframes()[p.place].record->segment == young_segment_
                                : !is_on_path(p);
  };
  const auto end = std::remove_if(found.begin(), found.end(), is_off);
  counts_.beyond_drift += int(found.end() - end);
  found.erase(end, found.end());
  const auto is_apart = [&](const Proved& p) {
    return known.store->is_one_unit(found.front().place, p.place) && !agree(found.front(), p, known, row);
  };
  if (found.empty() || std::none_of(found.begin() + 1, found.end(), is_apart)) return found;
  counts_.ambiguous += int(found.size());
  return {};
}

// A place of the newest keyframe and those of keyframes before it, one of each, that agree with it.
std::vector<PlaceMemory::Proved*> PlaceMemory::agreeing_with(Proved* newest, const Known& known, Row* row) {
  std::vector<Proved*> agreeing{newest};
  for (size_t i = 0; i + 1 < row->recent.size(); ++i) {
    std::vector<Proved>& before = row->recent[i];
    const auto found = std::find_if(before.begin(), before.end(),
                                    [&](const Proved& p) { return agree(p, *newest, known, *row); });
    if (found != before.end()) agreeing.push_back(&*found);
  }
  return agreeing;
}

Constraint PlaceMemory::constraint_of(const Proved& p, const Known& known, const Row& row) const {
  Constraint c;
  c.kind = ConstraintKind::kPlace;
  c.to = NodeId::keyframe(row.store->keyframes()[p.query].id);
  c.T_from_to = p.match.T_a_b;
  c.covariance = symmetric(p.match.covariance);
  if (&known == &own_) {
    c.from = NodeId::keyframe(store_.keyframes()[p.place].id);
    return c;
  }
  const Sim3 T_world_place{1, known.store->keyframes()[p.place].record->T_world_cam};
  c.T_from_to = T_world_place * c.T_from_to;
  c.covariance = symmetric(moved(T_world_place, c.covariance));
  return c;
}

void PlaceMemory::state(Proved* p, Known* known, Row* row) {
  if (p->is_stated) return;
  p->is_stated = true;
  const bool is_young = row == &known->young;
  const Constraint constraint = constraint_of(*p, *known, *row);
  const bool is_sound = constraint.T_from_to.rigid.is_finite() && constraint.covariance.allFinite() &&
                        Eigen::LLT<Matrix7d>(constraint.covariance).info() == Eigen::Success;
  if (!is_sound || (known == &own_ && !is_young && is_known_already(*p))) return;
  if (row->store->keyframes()[p->query].record->segment == young_segment_) {
    known->is_sought = false;
    if (!is_young) withdraw(&known->young);
  }
  const int number = log_->add_constraint(constraint);
  if (is_young) row->stated.push_back(number);
  if (!is_young) ++(known == &own_ ? counts_.stated : counts_.in_kept_map);
}

// What keyframes in the window have said.
void PlaceMemory::withdraw(Row* young) {
  for (const int constraint : young->stated) log_->withdraw_constraint(constraint);
  young->stated.clear();
}

}  // namespace edgevo
