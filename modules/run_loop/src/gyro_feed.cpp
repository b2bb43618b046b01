// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_loop/gyro_feed.h"

namespace edgevo {

std::string GyroFeed::mismatch() const {
  if (!first_ || !first_frame_) return {};
  const std::string images =
      "the images are of " + to_string(*first_frame_) + " to " + to_string(*last_frame_) + " s";
  if (*last_frame_ < *first_)
    return "not used: its samples begin at " + to_string(*first_) + " s, and " + images + ": another clock?";
  if (!next_ && newest_ && *newest_ < *first_frame_)
    return "not used: its samples end at " + to_string(*newest_) + " s, and " + images + ": another clock?";
  return {};
}

}  // namespace edgevo
