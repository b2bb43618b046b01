// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Section of report.html with the map in 3D, the path of the camera and the true path, if known.
#include <string>

#include "edgevo/report/run_report.h"
#include "shown_path.h"

namespace edgevo {

/// The section as HTML, in the unit of `path`.
std::string map_view_section(const ReportInput& in, const ShownPath& path);

}  // namespace edgevo
