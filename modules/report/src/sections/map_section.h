// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Section of report.html on the map: the grid from above with the path of the camera, statistics of the
// octree.
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/report/map_report.h"

namespace edgevo {

/// The section as HTML. An empty map gives a sentence that says so.
std::string map_section(const Run& run, const MapReport& map);

}  // namespace edgevo
