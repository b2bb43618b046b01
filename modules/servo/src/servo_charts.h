// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Charts of a servo run.
#include <string>
#include <vector>

#include "edgevo/report/chart.h"
#include "edgevo/report/plan.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"

namespace edgevo {

/// True and estimated error over the servo phase.
std::vector<TimeChart> error_charts(const ServoResult& r, const ServoParams& params);
/// Speed, age of the pose and latency of the odometry.
std::vector<TimeChart> loop_charts(const ServoResult& r);
/// States of the loop (steered, stopped) over time, with a legend.
std::string state_ribbon(const ServoResult& r);
/// True path of the camera in the axes of the taught camera, seen along its y axis: z forward, -x left.
Plan path_plan(const ServoResult& r);

/// The error charts below each other in one stand-alone SVG file.
std::string convergence_svg(const ServoResult& r, const ServoParams& params);

}  // namespace edgevo
