// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scale along a path: an estimate every tenth of an interval, each from the interval around it, with
// linear interpolation between them. Slow drift is followed; jitter is averaged.
#include <functional>
#include <optional>
#include <vector>

#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_estimate.h"

namespace edgevo {

/// Fits the scale between two travelled distances (units of the run); nullopt if that interval determines
/// none.
using FitInterval = std::function<std::optional<ScaleEstimate>(double begin_distance, double end_distance)>;

/// One estimate for each pose of `path`. The interval, `interval` metres long, is centred on the pose and
/// kept inside the path at both ends. A pose whose interval has no estimate takes the value interpolated
/// between its neighbours. Empty if no interval has an estimate. Cost: ten fits for each interval of the
/// path, and one of the whole path.
std::vector<ScaleEstimate> slide(const Path& path, double interval, const FitInterval& fit);

}  // namespace edgevo
