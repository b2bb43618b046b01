// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The clock of the images of a recording, for its other sensors.
#include <vector>

#include "edgevo/core/clock_shifts.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Follows the clock of the images through a recording. Cost: none.
class ImageClock {
 public:
  /// `times`: the stated times of all images in their order; empty: times stay as they are.
  explicit ImageClock(const std::vector<Timestamp>& times);

  /// A message comes; if it is the next image, the clock goes on with it.
  void pass(Timestamp stated);
  /// The time of a message as the frames have it, where the clock was set back. Between the image before and
  /// the one after a step of the clock, that of the nearer time holds.
  Timestamp correct(Timestamp stated) const;

 private:
  double distance(Timestamp stated, size_t image) const;

  std::vector<Timestamp> times_, without_gaps_;
  std::vector<int64_t> shifts_;  // ticks
  size_t next_ = 0;
};

}  // namespace edgevo
