#pragma once
// What a run cost in report.html: CPU time by stage over the run and as a table, and how a realtime run kept
// up.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// A section of the page; of a run with frames.
std::string timing_section(const Run& run);

}  // namespace edgevo
