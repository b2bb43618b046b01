// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Time axis of the charts of a run.
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Time of each frame since the first, seconds.
std::vector<double> seconds_of(const Run& run);

}  // namespace edgevo
