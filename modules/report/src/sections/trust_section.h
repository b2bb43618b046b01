// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/report/run_report.h"

namespace edgevo {

/// Section "Trust": p_right over time, each doubtful interval with its reason, and pictures of the longest.
std::string trust_section(const ReportInput& in);

}  // namespace edgevo
