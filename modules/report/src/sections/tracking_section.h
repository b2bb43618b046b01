#pragma once
// What happened in report.html: states, inlier share, residual, edges over the run.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// A section of the page; of a run with frames.
std::string tracking_section(const Run& run);

}  // namespace edgevo
