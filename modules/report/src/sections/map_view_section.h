#pragma once
// The map in 3D in report.html, with the way of the camera and, where it is known, the true one.
#include <string>

#include "edgevo/report/run_report.h"
#include "shown_path.h"

namespace edgevo {

/// A section of the page, in the unit of `path`.
std::string map_view_section(const ReportInput& in, const ShownPath& path);

}  // namespace edgevo
