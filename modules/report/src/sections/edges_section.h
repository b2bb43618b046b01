// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Section of report.html with keyframes and the edge points of the map, coloured by inverse depth.
#include <string>

#include "edgevo/report/run_report.h"

namespace edgevo {

/// The section as HTML.
std::string edges_section(const ReportInput& in);

}  // namespace edgevo
