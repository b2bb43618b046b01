// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Poses of the frames between keyframes, which were tracked against points that the map has since refined.
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/edge_map/edge_depth.h"
#include "edgevo/edge_map/view_alignment.h"

namespace edgevo {

/// Aligns the views that were only tracked (EdgeView::is_tracked) to lines that are known, as `points` of the
/// host. A view whose image supports the new pose too little for a frame of tracking keeps its own: few lines
/// in view, or another minimum. Cost: 0.4 ms for 1000 points and one view.
void align_tracked_views(std::vector<CloudPoint> points, const ViewAlignment& how,
                         std::vector<EdgeView>* views);

}  // namespace edgevo
