// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Section of report.html on the trajectory: from above and over time, with the ground truth if known.
#include <string>

#include "edgevo/report/run_report.h"
#include "shown_path.h"

namespace edgevo {

/// The section as HTML. `why_not`: reason why there is no comparison with ground truth; empty if none is
/// known.
std::string trajectory_section(const ReportInput& in, const std::optional<TruthComparison>& truth,
                               const std::string& why_not);

}  // namespace edgevo
