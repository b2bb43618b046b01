// SPDX-License-Identifier: BSD-3-Clause
#include "concurrent_bootstrap.h"

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

ConcurrentBootstrap::ConcurrentBootstrap(const Rectification& rectification, const OdometryParams& params,
                                         uint64_t seed, MapLink* map)
    : pinhole_(rectification.target()),
      params_(params),
      map_(map),
      bootstrap_(rectification, params.mapping.bootstrap, seed) {
  thread_ = std::thread([this] { search(); });
}

ConcurrentBootstrap::~ConcurrentBootstrap() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void ConcurrentBootstrap::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  queue_.clear();
  status_ = {};
  rests_ = false;
  is_reset_ = true;
  if (!frames_wait()) late_.clear();
}

BootstrapStatus ConcurrentBootstrap::look(const ArrivedFrame& now, OwnParts& own_parts,
                                          const std::optional<SureView>& before) {
  catches_up_ = false;
  add({now.frame.index, now.frame.time, now.pyramid, now.rows.expected});
  late_.add(now);
  BootstrapStatus status = poll();
  if (status.result && own_parts.delays_map(*now.pyramid)) {
    resume();
    return {std::nullopt, OwnParts::kDelayReason};
  }
  late_.drop_until(status.result ? status.result->views.back().frame_index : searched_until());
  if (!status.result) return status;
  make_map(std::move(*status.result), before);
  return {std::nullopt, "two views found: a map is being made"};
}

void ConcurrentBootstrap::add(Waiting frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (queue_.size() >= kMaxQueued) queue_.pop_front();
    queue_.push_back(std::move(frame));
  }
  wake_.notify_all();
}

BootstrapStatus ConcurrentBootstrap::poll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  BootstrapStatus status{std::exchange(status_.result, std::nullopt), status_.reason};
  if (status.reason.empty()) status.reason = "first view taken";
  return status;
}

void ConcurrentBootstrap::resume() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    rests_ = false;
  }
  wake_.notify_all();
}

int ConcurrentBootstrap::searched_until() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return searched_until_;
}

void ConcurrentBootstrap::search() {
  name_traced_thread("bootstrap");
  int followed = 0;  // frames since the last attempt
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stop_ || (!rests_ && !queue_.empty()); });
    if (stop_) return;
    const Waiting frame = std::move(queue_.front());
    queue_.pop_front();
    const bool attempt = queue_.empty() || followed >= kMaxFollowed;
    followed = attempt ? 0 : followed + 1;
    const bool was_reset = std::exchange(is_reset_, false);
    lock.unlock();
    BootstrapStatus status;
    {
      const TraceScope traced("search of two views", frame.frame_index);
      if (was_reset) bootstrap_.reset();
      status = bootstrap_.add(frame.frame_index, frame.time, frame.pyramid, attempt, frame.rows);
    }
    lock.lock();
    searched_until_ = frame.frame_index;
    if (is_reset_) continue;  // meanwhile
    rests_ = status.result.has_value();
    status_ = std::move(status);
  }
}

void ConcurrentBootstrap::make_map(BootstrapResult views, std::optional<SureView> before) {
  making_ = std::async(std::launch::async, [this, made = MadeMap{{}, std::move(views), {}},
                                            before = std::move(before)]() mutable {
    name_traced_thread("first map");
    const TraceScope traced("first map", made.views.views.back().frame_index);
    map_->rectify_rows(&made.views);
    made.problem = map_->make_map(made.views);
    if (!made.problem.empty()) return std::move(made);
    const std::shared_ptr<const Reference> reference = map_->first_reference();
    made.beginning.tracks = track_bootstrap_frames(made.views, *reference, params_);
    const TraceScope linking("link to the map before");
    made.beginning.link = find_link(pinhole_, before, *reference);
    return std::move(made);
  });
  reset();  // of the search alone: frames wait now
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
