#pragma once
// The unit of lengths in report.html: where the metre comes from, how certain it is, and what its drift was;
// the lens.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

std::string scale_section(const Run& run);

}  // namespace edgevo
