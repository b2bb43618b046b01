// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sources of scale that did not count over some frames, in words: for the closing lines of `edgevo run`,
// summary.yaml and the report.
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// "odometry: lengths +20 +- 1 % off those of the rest in frames 120 to 180; not used there", or the
/// like for positions that are displaced and for a source that gave no scale at all.
std::string to_string(const ScaleFault& fault);

/// All faults of the run: clocks that are off, then the others by source and time.
std::vector<std::string> scale_faults_in_words(const Run& run);

}  // namespace edgevo
