// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/live_feed.h"

#include <algorithm>
#include <chrono>

#include "edgevo/core/error.h"
#include "edgevo/core/trace.h"

namespace edgevo {
namespace {

// Ctrl-C acts at once, and polling costs nothing.
constexpr std::chrono::duration<double> kPollStop(0.05);

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
    : source_(source),
      pace_(pace),
      is_live_(source.is_live()),
      clock_(std::move(clock)),
      waiting_(is_live_ ? kMaxWaiting : kReadAhead),
      reader_({"reading"}) {
  if (is_live_ && pace.kind != Pace::Kind::kAtOnce)
    throw InputError("--pace", "a live camera paces itself", "omit --pace");
  reader_.submit([this] { read_all(); });
}

LiveFeed::~LiveFeed() { waiting_.close(); }

// ---- the reading thread

void LiveFeed::read_all() {
  try {
    while (std::optional<Frame> frame = read())
      if (!keep(std::move(*frame))) break;
  } catch (...) {
    waiting_.close();  // reader_ keeps the exception for the other thread
    throw;
  }
  waiting_.close();
}

std::optional<Frame> LiveFeed::read() {
  const TraceScope traced("read");
  return source_.next();
}

// False: no more frames are wanted.
bool LiveFeed::keep(Frame frame) {
  Waiting waiting{std::move(frame), clock_->now_s()};
  if (!is_live_) return waiting_.push_when_room(std::move(waiting));
  keep_newest(std::move(waiting));
  return !waiting_.is_closed();
}

void LiveFeed::keep_newest(Waiting waiting) {
  // Whoever takes a frame that came after a dropped one finds that one in the list.
  const std::lock_guard<std::mutex> lock(dropping_);
  std::optional<Waiting> oldest;
  waiting_.push_over_oldest(std::move(waiting), &oldest);
  if (!oldest) return;
  oldest->frame.image = {};
  dropped_.push_back(std::move(oldest->frame));
}

// ---- the thread that uses the frames

std::optional<LiveFeed::Waiting> LiveFeed::wait_for_frame(const std::function<bool()>& stop) {
  while (true) {
    if (std::optional<Waiting> waiting = waiting_.pop_within(kPollStop)) return waiting;
    if (waiting_.is_finished()) break;
    if (stop()) return std::nullopt;
  }
  reader_.wait_idle();
  return std::nullopt;
}

double LiveFeed::due_s(const Waiting& waiting) {
  if (is_live_) return waiting.came_s;
  const double now = clock_->now_s();
  if (pace_.kind == Pace::Kind::kAtOnce) return now;
  if (delivered_ == 0) first_time_ = waiting.frame.time, first_due_s_ = now;
  return first_due_s_ + pace_.due_s(delivered_, first_time_, waiting.frame.time);
}

std::optional<FedFrame> LiveFeed::next(const std::function<bool()>& stop) {
  const TraceScope traced("wait until due");
  std::optional<Waiting> waiting = wait_for_frame(stop);
  if (!waiting) return std::nullopt;
  FedFrame fed;
  fed.due_s = due_s(*waiting);
  while ((fed.delivered_s = clock_->now_s()) < fed.due_s) {
    if (stop()) return std::nullopt;
    clock_->sleep_s(std::min(fed.due_s - fed.delivered_s, kPollStop.count()));
  }
  ++delivered_;
  fed.frame = std::move(waiting->frame);
  fed.dropped = dropped_before(fed.frame.index);
  return fed;
}

std::vector<Frame> LiveFeed::dropped_before(int index) {
  const std::lock_guard<std::mutex> lock(dropping_);
  const auto is_before = [&](const Frame& dropped) { return dropped.index < index; };
  const auto end = std::find_if_not(dropped_.begin(), dropped_.end(), is_before);
  std::vector<Frame> found(std::make_move_iterator(dropped_.begin()), std::make_move_iterator(end));
  dropped_.erase(dropped_.begin(), end);
  return found;
}

}  // namespace edgevo
