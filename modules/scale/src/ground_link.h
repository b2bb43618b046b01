// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/records.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// Brings the parts of a finished run whose units of length nothing links (run_quality/doubtful_intervals.h),
/// or features less certainly, to one unit, by the camera's height over the ground before and after
/// (ground_height.h): for vehicles, whose height does not change. It averages over a part, features over two
/// views of it. A part that shows no ground keeps the unit it has. Final poses, depths and
/// covariances change; live poses are those of their time. What links two neighbouring parts is written to
/// the evidence of the frame that compared them (RelativeScale::by_ground). Cost: 5 ms for 100 keyframes if
/// there are such parts, else nothing.
void link_units_by_ground(const ScaleParams& params, Run* run);

}  // namespace edgevo
