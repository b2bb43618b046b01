// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/own_parts.h"

#include <cmath>
#include <cstdio>

namespace edgevo {
namespace {

// Of the image: as much as changes a map, and is worth a line.
constexpr double kWorthSaying = 0.01;
constexpr int kMaxDelayed = 30;  // frames

}  // namespace

bool OwnParts::take(const FramePyramid& frame) {
  if (frame.own_mask == newest_) return false;
  newest_ = frame.own_mask;
  const double share = frame.own_share();
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

bool OwnParts::delays_map(bool may_show_own_part) {
  if (!may_show_own_part) return false;
  return ++delayed_ <= kMaxDelayed;
}

}  // namespace edgevo
