// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Section of report.html on the unit of length (source, uncertainty and drift of the scale) and on the lens.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// The section as HTML.
std::string scale_section(const Run& run);

}  // namespace edgevo
