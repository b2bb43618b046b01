#pragma once
// The map in report.html: the grid from above with the camera's way, what the octree holds, at which
// resolution.
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/report/map_report.h"

namespace edgevo {

/// A section of the page. A map of nothing gives a sentence that says so.
std::string map_section(const Run& run, const MapReport& map);

}  // namespace edgevo
