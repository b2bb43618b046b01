// SPDX-License-Identifier: BSD-3-Clause
#include "view_poses.h"

#include <utility>

#include "edgevo/alignment/edge_alignment.h"

namespace edgevo {

void align_tracked_views(std::vector<CloudPoint> points, std::vector<EdgeView>* views) {
  constexpr size_t kAtLeast = 100;  // points: each has one equation for six unknowns, and some are wrong
  if (points.size() < kAtLeast) return;
  ReferenceCloud cloud;
  cloud.points = std::move(points);
  for (EdgeView& view : *views)
    if (view.is_tracked) align_edges(*view.pyramid, cloud, 0, AlignmentParams(), &view.T_view_host);
}

}  // namespace edgevo
