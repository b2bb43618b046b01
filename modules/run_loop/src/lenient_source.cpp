// SPDX-License-Identifier: BSD-3-Clause
#include "lenient_source.h"

#include <utility>

namespace edgevo {
namespace {

// Frames without a usable time at the start before a source is taken to have none at all.
constexpr size_t kMaxBadFirst = 10;

// "WHERE: WHAT; REMEDY" without the remedy.
std::string without_remedy(const std::string& message) { return message.substr(0, message.rfind("; ")); }

}  // namespace

std::optional<Frame> LenientSource::next() {
  if (waiting_.empty()) {
    std::optional<Frame> frame = next_in_order();
    if (good_came_ || !frame) return frame;
    good_came_ = true;
    waiting_.push_back(std::move(*frame));
  }
  Frame first = std::move(waiting_.front());
  waiting_.pop_front();
  return first;
}

// Frames without a usable time before the first good one wait for it, whose time theirs precede by ticks.
std::optional<Frame> LenientSource::next_in_order() {
  for (;;) try {
      std::optional<Frame> frame = inner_.next();
      for (size_t i = waiting_.size(); frame && i > 0; --i)
        waiting_[i - 1].time.ticks = frame->time.ticks - int64_t(waiting_.size() - i + 1);
      return frame;
    } catch (const BadFrame& e) {
      const bool is_bad_time = e.what_is_bad() == BadFrame::What::kTime;
      if (!good_came_ && (!is_bad_time || waiting_.size() == kMaxBadFirst)) throw;
      const std::lock_guard<std::mutex> lock(mutex_);
      reasons_[e.index()] = without_remedy(e.what());
      Frame bad{e.index(), e.time(), {}, {}};
      if (good_came_) return bad;
      waiting_.push_back(std::move(bad));
    }
}

std::string LenientSource::take_reason(int frame_index) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto reason = reasons_.find(frame_index);
  if (reason == reasons_.end()) return {};
  std::string text = std::move(reason->second);
  reasons_.erase(reason);
  return text;
}

}  // namespace edgevo
