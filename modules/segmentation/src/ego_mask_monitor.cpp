// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/ego_mask_monitor.h"

#include <cmath>
#include <cstdio>

namespace edgevo {
namespace {

// Of the image: as much as changes a map, and is worth a line.
constexpr double kWorthSaying = 0.01;
constexpr int kMaxDelayed = 30;  // frames

}  // namespace

bool EgoMaskMonitor::take(const FramePyramid& frame) {
  if (frame.ego_mask == newest_) return false;
  newest_ = frame.ego_mask;
  const double share = frame.ego_share();
  if (std::abs(share - share_) < kWorthSaying) return false;
  char line[120];
  if (share > 0)
    std::snprintf(line, sizeof line,
                  "mask: %.0f %% of the image is fixed to the camera; no edges are taken there", 100 * share);
  else
    std::snprintf(line, sizeof line, "mask: taken back, what it covered has moved");
  description_ = line;
  share_ = share;
  return true;
}

bool EgoMaskMonitor::delays_map(bool may_show_ego_part, const StillCells& still, int images) {
  return still.images >= images || (may_show_ego_part && ++delayed_ <= kMaxDelayed);
}

}  // namespace edgevo
