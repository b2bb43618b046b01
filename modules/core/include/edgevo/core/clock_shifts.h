// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the clock of a recording is corrected where it was set back, for other sensors of the same recording.
#include <cstdint>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// What TimeOrder (time_order.h) adds to each of `times`, the stated times of all images in their order,
/// ticks. The frames that only show that the clock was set back, and are skipped, have the new value, too.
std::vector<int64_t> clock_shifts(const std::vector<Timestamp>& times);

}  // namespace edgevo
