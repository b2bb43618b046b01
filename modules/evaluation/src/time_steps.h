#pragma once
// Small helpers on sorted times.
#include <cstdint>
#include <vector>

#include "edgevo/core/timestamp.h"
#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

std::vector<Timestamp> times_of(const Trajectory& trajectory);

/// Median of the steps between neighbours, ticks; 0 with fewer than two times.
int64_t median_step_ticks(const std::vector<Timestamp>& times);

/// Index of the time nearest to `t`; `times` must not be empty.
int nearest_index(const std::vector<Timestamp>& times, Timestamp t);

}  // namespace edgevo
