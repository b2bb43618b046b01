// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Poses of the frames between keyframes, which were tracked against points that the map has since refined.
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/edge_map/edge_depth.h"

namespace edgevo {

/// Aligns the views that were only tracked (EdgeView::is_tracked) to lines that are known, as `points` of the
/// host. Cost: 0.3 ms for 1000 points and one view.
void align_tracked_views(std::vector<CloudPoint> points, std::vector<EdgeView>* views);

}  // namespace edgevo
