// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// report.html of a servo run.
#include <string>
#include <vector>

#include "edgevo/servo/servo_outputs.h"
#include "servo_views.h"

namespace edgevo {

/// The report as HTML.
std::string servo_report(const ServoResult& r, const ServoRunInfo& info, const std::vector<ServoView>& views);

}  // namespace edgevo
