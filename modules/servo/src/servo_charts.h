#pragma once
// The charts of a servo run.
#include <string>
#include <vector>

#include "edgevo/report/chart.h"
#include "edgevo/report/plan.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"

namespace edgevo {

/// True and believed error over the time that the loop steered.
std::vector<TimeChart> error_charts(const ServoResult& r, const ServoParams& params);
/// Speed, age of the pose and latency of the odometry.
std::vector<TimeChart> loop_charts(const ServoResult& r);
/// When it was steered, and when stopped, with a legend.
std::string state_ribbon(const ServoResult& r);
/// The camera's true path in the taught camera's axes, seen along its y axis: z forward, -x left.
Plan path_plan(const ServoResult& r);

/// The error charts below each other in one drawing that stands alone.
std::string convergence_svg(const ServoResult& r, const ServoParams& params);

}  // namespace edgevo
