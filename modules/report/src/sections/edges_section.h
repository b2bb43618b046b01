#pragma once
// What the camera saw in report.html: keyframes with the edge points of the map, coloured by inverse depth.
#include <string>

#include "edgevo/report/run_report.h"

namespace edgevo {

std::string edges_section(const ReportInput& in);

}  // namespace edgevo
