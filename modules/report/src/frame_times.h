#pragma once
// The x of the charts of a run.
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Seconds of each frame since the first.
std::vector<double> seconds_of(const Run& run);

}  // namespace edgevo
