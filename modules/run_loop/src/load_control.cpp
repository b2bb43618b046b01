// SPDX-License-Identifier: BSD-3-Clause
#include "load_control.h"

#include <algorithm>

namespace edgevo {
namespace {

// Seconds after its due time from which a frame is late, and very late: half an interval of 30 frames/s, and
// two. A thread that wakes up takes a few milliseconds at most.
constexpr double kBehindS = 0.016, kFarBehindS = 0.066;
constexpr int kLateFrames = 3, kFramesInTime = 60;

}  // namespace

void LoadControl::shed(int steps) {
  shedding_ = Shedding(std::clamp(int(shedding_) + steps, int(Shedding::kNothing), int(Shedding::kPoints)));
  late_ = in_time_ = 0;
}

Shedding LoadControl::next(double late_s) {
  if (late_s > kBehindS) {
    in_time_ = 0;
    if (++late_ >= kLateFrames || late_s > kFarBehindS) shed(+1);
  } else {
    late_ = 0;
    if (++in_time_ >= kFramesInTime) shed(-1);
  }
  return shedding_;
}

}  // namespace edgevo
