// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_memory.h"
#include "queries_in_a_row.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <iterator>

namespace edgevo {
namespace {

// Keyframes closer than this are still in the window, or show what the window has seen.
constexpr size_t kLeastGap = 30;
// Of keyframes in the window, which are looked up all along: all of them.
constexpr size_t kWindow = 12;

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
  if (!e.neighbours.empty()) k.next = e.neighbours.front();
  if (e.pyramid && !e.keyframe->is_doubtful) k.view = view_of(e.id, e.pyramid);
  views_.erase(e.id), passed_on_.erase(e.id);
  remember(std::move(k));
}

int PlaceMemory::epoch_of(int keyframe) const {
  return int(std::distance(first_of_epoch_.begin(), first_of_epoch_.upper_bound(keyframe)));
}

void PlaceMemory::remember(StoredKeyframe k) {
  k.epoch = epoch_of(k.id);
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

// Made once of each pyramid: one that the camera's correction has rebuilt is another.
std::shared_ptr<const RememberedView> PlaceMemory::view_of(
    int id, const std::shared_ptr<const FramePyramid>& pyramid) {
  YoungView& young = views_[id];
  if (young.of.lock() != pyramid)
    young = {pyramid, std::make_shared<const RememberedView>(remember_view(*pyramid))};
  return young.view;
}

void PlaceMemory::pass_on_young(const WindowAdjusted& e) {
  for (const WindowAdjusted::Active& k : *e.keyframes)
    if (k.pyramid && !k.keyframe.is_doubtful && passed_on_.insert(k.id).second)
      on_young_({k.id, epoch_of(k.id), std::make_shared<const KeyframeRecord>(k.keyframe),
                 view_of(k.id, k.pyramid), std::nullopt});
}

void PlaceMemory::handle(const WindowAdjusted& e) {
  if (e.keyframes && on_young_) pass_on_young(e);
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
  StoredKeyframe k{active.id, 0, std::make_shared<const KeyframeRecord>(active.keyframe), nullptr, {}};
  if (active.pyramid && !active.keyframe.is_doubtful) k.view = view_of(active.id, active.pyramid);
  if (same != all.end()) return young_.update(size_t(same - all.begin()), std::move(k));
  young_.add(std::move(k));
}

// ---- keyframes that have left it ----

void PlaceMemory::finish() {
  const size_t waiting = std::min(store_.size(), PlaceStore::kAround);
  for (size_t query = store_.size() - waiting; looks_up_ && query < store_.size(); ++query) look_up(query);
}

void PlaceMemory::handle(const MapMoved& e) {
  store_.move(rectification_, e);
  passed_on_.clear();
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
  const bool is_corrected = looks_up_young_ && row == &known->young;
  if (row->recent.size() > (is_corrected ? kWindow : kRecent)) row->recent.pop_front();
  std::vector<Proved>& newest = row->recent.back();
  if (newest.empty()) return;
  std::vector<Proved*> agreeing = agreeing_with(&newest.front(), *known, row);
  if (is_corrected && agreeing.size() < kAgreeing) {
    prove_anew(known, row);
    agreeing = agreeing_with(&newest.front(), *known, row);
  }
  if (agreeing.size() >= kAgreeing)
    for (Proved* p : agreeing) state(p, known, row);
}

std::optional<PlaceMatch> PlaceMemory::match(size_t place, size_t query, const Known& known,
                                             const Row& row) const {
  const PlaceView a{*known.store->keyframes()[place].view, known.store->points_around(place)},
      b{*row.store->keyframes()[query].view, row.store->points_around(query)};
  return match_views(store_.pinhole(), a, b);
}

// A map of few views is bent: what was proved of its keyframes is measured anew as they are now.
void PlaceMemory::prove_anew(Known* known, Row* row) {
  for (std::vector<Proved>& of_one : row->recent)
    for (Proved& p : of_one) {
      const std::optional<PlaceMatch> now = match(p.place, p.query, *known, *row);
      if (!now) continue;
      p.T_place_query = now->T_a_b, p.covariance = now->covariance;
      const auto [first, last] = row->stated.equal_range(row->store->keyframes()[p.query].id);
      const auto stated = std::find_if(first, last, [&](const auto& s) { return s.second == p.constraint; });
      if (!p.is_stated || stated == last) continue;
      log_->withdraw_constraint(stated->second);
      row->stated.erase(stated);
      p.is_stated = false;
      state(&p, known, row);
    }
}

std::vector<PlaceMemory::Proved> PlaceMemory::prove(size_t query, const std::vector<int>& views,
                                                    const Known& known, const Row& row) {
  std::vector<Proved> proved;
  for (const int view : views) {
    const size_t place = known.keyframe_of[size_t(view)];
    const std::optional<PlaceMatch> found = match(place, query, known, row);
    if (!found) continue;
    ++counts_.proved;
    proved.push_back({{place, query, found->T_a_b, found->covariance}, found->evidence, false});
  }
  std::stable_sort(proved.begin(), proved.end(), [](const Proved& a, const Proved& b) {
    return a.evidence.edges_log_alarms < b.evidence.edges_log_alarms;
  });
  return proved;
}

// Whether the path between the two, as far as it may be off, allows the place.
bool PlaceMemory::is_on_path(const Proved& p) const {
  if (!store_.is_one_unit(p.place, p.query)) return true;
  const Sim3 by_path{1, store_.T_a_b(p.place, p.query)};
  return squared_distance(p.T_place_query, by_path, store_.path_covariance(p.place, p.query) + p.covariance) <
         kThreeSigmas;
}

// Whether the path between the two is more certain than what their views show: at a standstill, or at a desk.
bool PlaceMemory::is_known_already(const Proved& p) const {
  return store_.is_one_unit(p.place, p.query) &&
         store_.path_covariance(p.place, p.query).trace() < p.covariance.trace();
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
    return known.store->is_one_unit(found.front().place, p.place) &&
           !agree(found.front(), p, *known.store, *row.store);
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
    const auto found = std::find_if(before.begin(), before.end(), [&](const Proved& p) {
      return agree(p, *newest, *known.store, *row->store);
    });
    if (found != before.end()) agreeing.push_back(&*found);
  }
  return agreeing;
}

void PlaceMemory::state(Proved* p, Known* known, Row* row) {
  if (p->is_stated) return;
  p->is_stated = true;
  const bool is_young = row == &known->young;
  const Constraint constraint = known == &own_ ? constraint_of(*p, *known->store, *row->store)
                                               : constraint_in_world(*p, *known->store, *row->store);
  const bool is_sound = constraint.T_from_to.rigid.is_finite() && constraint.covariance.allFinite() &&
                        Eigen::LLT<Matrix7d>(constraint.covariance).info() == Eigen::Success;
  if (!is_sound || (known == &own_ && !is_young && is_known_already(*p))) return;
  const int keyframe = row->store->keyframes()[p->query].id;
  if (row->store->keyframes()[p->query].record->segment == young_segment_) {
    known->is_sought = looks_up_young_ && known == &kept_;
    if (!is_young) withdraw(known->is_sought ? keyframe : std::numeric_limits<int>::max(), &known->young);
  }
  const int number = log_->add_constraint(constraint);
  if (is_young) {
    p->constraint = number;
    row->stated.emplace(keyframe, number);
    return;
  }
  ++(known == &own_ ? counts_.stated : counts_.in_kept_map);
  if (known == &kept_) on_found_(constraint_of(*p, *known->store, *row->store));
}

// What keyframes in the window have said.
void PlaceMemory::withdraw(int up_to_keyframe, Row* young) {
  const auto end = young->stated.upper_bound(up_to_keyframe);
  for (auto s = young->stated.begin(); s != end; ++s) log_->withdraw_constraint(s->second);
  young->stated.erase(young->stated.begin(), end);
}

}  // namespace edgevo
