// SPDX-License-Identifier: BSD-3-Clause
#include "time_steps.h"

#include <algorithm>

#include "edgevo/core/order_statistics.h"

namespace edgevo {

std::vector<Timestamp> times_of(const Trajectory& trajectory) {
  std::vector<Timestamp> times;
  times.reserve(trajectory.poses.size());
  for (const StampedPose& p : trajectory.poses) times.push_back(p.time);
  return times;
}

int64_t median_step_ticks(const std::vector<Timestamp>& times) {
  if (times.size() < 2) return 0;
  std::vector<int64_t> steps;
  steps.reserve(times.size() - 1);
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(times[i].ticks - times[i - 1].ticks);
  return median(std::move(steps));
}

int nearest_index(const std::vector<Timestamp>& times, Timestamp t) {
  const auto after = std::lower_bound(times.begin(), times.end(), t);
  if (after == times.begin()) return 0;
  if (after == times.end()) return int(times.size()) - 1;
  const auto before = std::prev(after);
  const bool before_is_nearer = t.ticks - before->ticks <= after->ticks - t.ticks;
  return int((before_is_nearer ? before : after) - times.begin());
}

}  // namespace edgevo
