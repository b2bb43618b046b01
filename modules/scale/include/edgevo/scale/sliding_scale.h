#pragma once
// The scale along a path: an estimate every tenth of a stretch, each from the stretch around it, straight
// lines between them. What drifts slowly is followed; what jitters is averaged.
#include <functional>
#include <optional>
#include <vector>

#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_estimate.h"

namespace edgevo {

/// The scale from what lies between two places of the way; nullopt if that tells none.
using FitStretch = std::function<std::optional<ScaleEstimate>(double way_begin, double way_end)>;

/// An estimate for each pose of `path`. The stretch, `stretch` metres long, lies around the pose; at both
/// ends of the path it stays inside. A pose whose stretch tells nothing takes the value between its
/// neighbours. Empty if no stretch tells anything. Cost: ten fits for each stretch of the path, and one of
/// the whole.
std::vector<ScaleEstimate> slide(const Path& path, double stretch, const FitStretch& fit);

}  // namespace edgevo
