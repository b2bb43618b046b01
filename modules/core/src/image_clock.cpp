// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/image_clock.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/time_order.h"

namespace edgevo {

ImageClock::ImageClock(const std::vector<Timestamp>& times)
    : times_(times), without_gaps_(fill_missing(times)), shifts_(clock_shifts(times)) {}

void ImageClock::pass(Timestamp stated) {
  if (next_ < times_.size() && stated == times_[next_]) ++next_;
}

Timestamp ImageClock::correct(Timestamp stated) const {
  if (times_.empty()) return stated;
  const size_t before = next_ > 0 ? next_ - 1 : 0, after = std::min(next_, times_.size() - 1);
  const size_t nearest = distance(stated, before) <= distance(stated, after) ? before : after;
  return {stated.ticks + shifts_[nearest]};
}

double ImageClock::distance(Timestamp stated, size_t image) const {
  return std::abs(seconds_between(without_gaps_[image], stated));
}

}  // namespace edgevo
