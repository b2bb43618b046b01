// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small helpers on sorted times.
#include <cstdint>
#include <vector>

#include "edgevo/core/timestamp.h"
#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// Times of all poses.
std::vector<Timestamp> times_of(const Trajectory& trajectory);

/// Median step between consecutive times, ticks; 0 for fewer than two times.
int64_t median_step_ticks(const std::vector<Timestamp>& times);

/// Index of the time nearest to `t`; `times` must not be empty.
int nearest_index(const std::vector<Timestamp>& times, Timestamp t);

}  // namespace edgevo
