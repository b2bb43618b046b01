// SPDX-License-Identifier: BSD-3-Clause
#include "frame_order.h"

#include "edgevo/core/error.h"

namespace edgevo {

void FrameOrder::require_next_index(const Frame& frame, const std::string& where) const {
  if (newest_index_ && frame.index <= *newest_index_)
    throw InputError(
        where, "its index is not after that of the frame before (" + std::to_string(*newest_index_) + ")",
        "count the frames");
}

void FrameOrder::refuse_time(const Frame& frame, const std::string& where, const char* relation) const {
  throw InputError(where,
                   "its time " + to_string(frame.time) + " s " + relation + " that of the frame before (" +
                       to_string(*newest_time_) + " s)",
                   "give frames in the order of their times; skip() those whose time is wrong");
}

void FrameOrder::take(const Frame& frame, const std::string& where) {
  require_next_index(frame, where);
  if (!has_own_time(frame)) refuse_time(frame, where, "is not after");
  newest_index_ = frame.index;
  newest_time_ = stated_time_ = frame.time;
}

Timestamp FrameOrder::take_skipped(const Frame& frame, const std::string& where) {
  require_next_index(frame, where);
  if (stated_time_ && frame.time < *stated_time_) refuse_time(frame, where, "is before");
  newest_time_ = has_own_time(frame) ? frame.time : Timestamp{newest_time_->ticks + 1};
  newest_index_ = frame.index;
  stated_time_ = frame.time;
  return *newest_time_;
}

}  // namespace edgevo
