// SPDX-License-Identifier: BSD-3-Clause
#include "lenient_source.h"

#include <utility>

namespace edgevo {
namespace {

// "WHERE: WHAT; REMEDY" without the remedy.
std::string without_remedy(const std::string& message) { return message.substr(0, message.rfind("; ")); }

}  // namespace

std::optional<Frame> LenientSource::next() {
  try {
    std::optional<Frame> frame = inner_.next();
    good_came_ |= frame.has_value();
    return frame;
  } catch (const BadFrame& e) {
    if (!good_came_) throw;
    const std::lock_guard<std::mutex> lock(mutex_);
    reasons_[e.index()] = without_remedy(e.what());
    return Frame{e.index(), e.time(), {}, {}};
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
