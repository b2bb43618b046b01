// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/concurrent_bootstrap.h"

#include <chrono>
#include <utility>

#include "edgevo/core/trace.h"

namespace edgevo {
namespace {
// More than arrive during an attempt, so that none is lost unless following the corners takes longer than a
// frame.
constexpr size_t kMaxQueued = 12;
// Frames that are only followed between two attempts of a search that is behind.
constexpr int kMaxFollowed = 3;
}  // namespace

ConcurrentBootstrap::ConcurrentBootstrap(const Rectification& rectification, const TrackingParams& params,
                                         const BootstrapParams& bootstrap, uint64_t seed, MapLink* map)
    : pinhole_(rectification.target()),
      params_(params),
      map_(map),
      bootstrap_(rectification, bootstrap, seed,
                 [this](Timestamp a, Timestamp b) { return located_.turn_between(a, b); }),
      worker_({"bootstrap", kMaxQueued, true, false, true}) {}

void ConcurrentBootstrap::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  queue_.clear();
  status_ = {};
  rests_ = false;
  is_reset_ = true;
  if (!frames_wait()) late_.clear();
}

BootstrapStatus ConcurrentBootstrap::look(const ArrivedFrame& now, EgoMaskMonitor& ego_mask_monitor,
                                          const std::optional<TrustedReference>& before,
                                          const std::optional<LocatedPose>& located, bool may_be_located) {
  catches_up_ = false;
  add({now.frame.index, now.frame.time, now.pyramid, now.rows.expected, located});
  late_.add(now);
  BootstrapStatus status = poll();
  if (status.result &&
      ego_mask_monitor.delays_map(now.may_show_ego_part, now.still, int(status.result->views.size()) - 1)) {
    resume();
    return {std::nullopt, {{ReasonKind::kMayBeEgoPart}}};
  }
  if (status.result && may_be_located) {
    resume();
    return {std::nullopt, {{ReasonKind::kMayBeLocated}}};
  }
  late_.drop_until(status.result ? status.result->views.back().frame_index : searched_until());
  if (!status.result && !now.still.empty())
    return {std::nullopt, {{now.still.is_certain ? ReasonKind::kStands : ReasonKind::kMayBeEgoPart}}};
  if (!status.result) return status;
  begin_map(std::move(*status.result), before);
  return {std::nullopt, {{ReasonKind::kMapBegun}}};
}

void ConcurrentBootstrap::add(Waiting frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (queue_.size() >= kMaxQueued) queue_.pop_front();
    queue_.push_back(std::move(frame));
  }
  worker_.submit([this] { search_next(); });
}

BootstrapStatus ConcurrentBootstrap::poll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  BootstrapStatus status{std::exchange(status_.result, std::nullopt), status_.reasons};
  if (status.reasons.empty()) status.reasons = {{ReasonKind::kFirstView}};
  return status;
}

void ConcurrentBootstrap::resume() {
  const std::lock_guard<std::mutex> lock(mutex_);
  rests_ = false;
  for (size_t i = 0; i < queue_.size(); ++i) worker_.submit([this] { search_next(); });
}

int ConcurrentBootstrap::searched_until() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return searched_until_;
}

std::optional<ConcurrentBootstrap::Search> ConcurrentBootstrap::next() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (rests_ || queue_.empty()) return std::nullopt;
  Search search{std::move(queue_.front()), false, std::exchange(is_reset_, false)};
  queue_.pop_front();
  search.attempt = queue_.empty() || followed_ >= kMaxFollowed;
  return search;
}

void ConcurrentBootstrap::search_next() {
  const std::optional<Search> now = next();
  if (!now) return;
  followed_ = now->attempt ? 0 : followed_ + 1;
  const Waiting& frame = now->frame;
  const TraceScope traced("search of two views", frame.frame_index);
  if (now->after_reset) bootstrap_.reset(), located_.clear();
  if (frame.located) located_.add(frame.frame_index, frame.time, *frame.located);
  BootstrapStatus status =
      bootstrap_.add(frame.frame_index, frame.time, frame.pyramid, now->attempt, frame.rows);
  const std::lock_guard<std::mutex> lock(mutex_);
  searched_until_ = frame.frame_index;
  if (is_reset_) return;  // meanwhile
  rests_ = status.result.has_value();
  status_ = std::move(status);
}

void ConcurrentBootstrap::begin_map(BootstrapResult views, std::optional<TrustedReference> before) {
  making_ = worker_.begin([this, views = std::move(views), before = std::move(before)]() mutable {
    return make_map(std::move(views), before);
  });
  reset();  // of the search alone: frames wait now
}

MadeMap ConcurrentBootstrap::make_map(BootstrapResult views, const std::optional<TrustedReference>& before) {
  const TraceScope traced("first map", views.views.back().frame_index);
  MadeMap made{{}, std::move(views), {}};
  map_->rectify_rows(&made.views);
  made.problem = map_->make_map(made.views);
  if (!made.problem.empty()) return made;
  const std::shared_ptr<const Reference> reference = map_->first_reference();
  made.beginning.tracks = track_bootstrap_frames(made.views, *reference, params_);
  const TraceScope linking("link to the map before");
  made.beginning.link = find_link(pinhole_, before, *reference);
  return made;
}

MadeMap ConcurrentBootstrap::take_map() {
  MadeMap made = making_.get();
  catches_up_ = made.problem.empty();
  if (!catches_up_) late_.clear();
  return made;
}

bool ConcurrentBootstrap::is_made() const {
  return making_.valid() && making_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace edgevo
