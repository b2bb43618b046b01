// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/live_feed.h"

#include <algorithm>
#include <chrono>

#include "edgevo/core/error.h"
#include "edgevo/core/trace.h"

namespace edgevo {
namespace {

constexpr double kAskForStopS = 0.05;  // seconds: Ctrl-C acts at once, and polling costs nothing

class SteadyClock : public FeedClock {
 public:
  double now_s() const override {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  void sleep_s(double seconds) override {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }
};

}  // namespace

std::shared_ptr<FeedClock> steady_clock() { return std::make_shared<SteadyClock>(); }

LiveFeed::LiveFeed(ImageSource& source, const Pace& pace, std::shared_ptr<FeedClock> clock)
    : source_(source), pace_(pace), is_live_(source.is_live()), clock_(std::move(clock)) {
  if (is_live_ && pace.kind != Pace::Kind::kAtOnce)
    throw InputError("--pace", "a live camera paces itself", "omit --pace");
  reader_ = std::thread([this] { read_all(); });
}

LiveFeed::~LiveFeed() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  room_.notify_all();
  reader_.join();
}

// ---- the reading thread

void LiveFeed::read_all() {
  name_traced_thread("reading");
  std::exception_ptr failure;
  try {
    while (std::optional<Frame> frame = read())
      if (!keep(std::move(*frame))) break;
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  failure_ = failure;
  ended_ = true;
  came_.notify_all();
}

std::optional<Frame> LiveFeed::read() {
  const TraceScope traced("read");
  return source_.next();
}

// False: no more frames are wanted.
bool LiveFeed::keep(Frame frame) {
  const double came_s = clock_->now_s();
  std::unique_lock<std::mutex> lock(mutex_);
  if (!is_live_) room_.wait(lock, [this] { return closed_ || waiting_.size() < kReadAhead; });
  if (closed_) return false;
  if (is_live_ && waiting_.size() >= kMaxWaiting) drop_oldest();
  waiting_.push_back({std::move(frame), came_s});
  came_.notify_all();
  return true;
}

void LiveFeed::drop_oldest() {
  Frame oldest = std::move(waiting_.front().frame);
  waiting_.pop_front();
  oldest.image = {};
  dropped_.push_back(std::move(oldest));
}

// ---- the thread that uses the frames

bool LiveFeed::wait_for_frame(const std::function<bool()>& stop, Waiting* waiting) {
  std::unique_lock<std::mutex> lock(mutex_);
  const std::chrono::duration<double> slice(kAskForStopS);
  while (!came_.wait_for(lock, slice, [this] { return ended_ || !waiting_.empty(); }))
    if (stop()) return false;
  if (waiting_.empty()) {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return false;
  }
  *waiting = std::move(waiting_.front());
  waiting_.pop_front();
  room_.notify_all();
  return true;
}

double LiveFeed::due_s(const Waiting& waiting) {
  if (is_live_) return waiting.came_s;
  const double now = clock_->now_s();
  if (pace_.kind == Pace::Kind::kAtOnce) return now;
  if (delivered_ == 0) first_time_ = waiting.frame.time, first_due_s_ = now;
  return first_due_s_ + pace_.due_s(delivered_, first_time_, waiting.frame.time);
}

std::optional<FedFrame> LiveFeed::next(const std::function<bool()>& stop) {
  Waiting waiting;
  const TraceScope traced("wait until due");
  if (!wait_for_frame(stop, &waiting)) return std::nullopt;
  FedFrame fed;
  fed.due_s = due_s(waiting);
  while ((fed.delivered_s = clock_->now_s()) < fed.due_s) {
    if (stop()) return std::nullopt;
    clock_->sleep_s(std::min(fed.due_s - fed.delivered_s, kAskForStopS));
  }
  ++delivered_;
  fed.frame = std::move(waiting.frame);
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto is_before = [&](const Frame& dropped) { return dropped.index < fed.frame.index; };
  const auto end = std::find_if_not(dropped_.begin(), dropped_.end(), is_before);
  fed.dropped.assign(std::make_move_iterator(dropped_.begin()), std::make_move_iterator(end));
  dropped_.erase(dropped_.begin(), end);
  return fed;
}

}  // namespace edgevo
