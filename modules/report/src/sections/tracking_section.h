// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Section of report.html on tracking: states, inlier share, residual and edges over the run.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// The section as HTML; needs a run with frames.
std::string tracking_section(const Run& run);

}  // namespace edgevo
