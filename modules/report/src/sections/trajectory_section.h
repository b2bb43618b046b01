#pragma once
// Where the camera went in report.html: from above and over time, beside the ground truth where that is
// known.
#include <string>

#include "edgevo/report/run_report.h"
#include "shown_path.h"

namespace edgevo {

/// A section of the page. `why_not`: why there is no comparison with the truth; empty if there is none to
/// compare with.
std::string trajectory_section(const ReportInput& in, const std::optional<TruthComparison>& truth,
                               const std::string& why_not);

}  // namespace edgevo
