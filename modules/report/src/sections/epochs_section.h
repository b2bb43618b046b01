// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Section of report.html on the intervals of one unit of length, and on what relates them.
#include <optional>
#include <string>

#include "edgevo/report/run_report.h"
#include "shown_path.h"

namespace edgevo {

/// The section as HTML; empty for a run of one epoch about whose past nothing was found.
std::string epochs_section(const ReportInput& in, const std::optional<TruthComparison>& truth);

}  // namespace edgevo
