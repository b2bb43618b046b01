// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Section of report.html on CPU time by stage, over the run and as a table, and on the latency of a realtime
// run.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// The section as HTML; needs a run with frames.
std::string timing_section(const Run& run);

}  // namespace edgevo
