// SPDX-License-Identifier: BSD-3-Clause
#include "frame_times.h"

namespace edgevo {

std::vector<double> seconds_of(const Run& run) {
  std::vector<double> seconds;
  for (const FrameRecord& f : run.frames) seconds.push_back(seconds_between(run.frames.front().time, f.time));
  return seconds;
}

}  // namespace edgevo
