// SPDX-License-Identifier: BSD-3-Clause
#include "first_frames.h"

#include <utility>

namespace edgevo {

std::optional<Frame> FirstFrames::next() {
  if (!keeps_ && kept_.empty()) return inner_.next();
  if (keeps_) {
    kept_.push_back(read());
    if (const std::optional<Frame>& frame = kept_.back().frame)
      kept_bytes_ += frame->image.pixels.size() + sizeof(uint16_t) * frame->image.values.size();
  }
  Answer answer = keeps_ ? kept_.back() : std::move(kept_.front());
  if (!keeps_) kept_.pop_front();
  if (answer.thrown) std::rethrow_exception(answer.thrown);
  return std::move(answer.frame);
}

FirstFrames::Answer FirstFrames::read() {
  try {
    return {inner_.next(), nullptr};
  } catch (...) {
    return {std::nullopt, std::current_exception()};
  }
}

}  // namespace edgevo
