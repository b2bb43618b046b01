// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a move of the map does to a height that was measured in it.
#include "edgevo/map/map_event.h"

namespace edgevo {

/// New over old height of the camera over a point that the moved keyframe hosts. With another focal length
/// the ground lies lower, or higher, at the same depth.
inline double height_ratio(const MapMoved& moved, const KeyframeMove& keyframe) {
  const double by_lens = moved.lens ? (1 + moved.lens->before.focal) / (1 + moved.lens->now.focal) : 1;
  return keyframe.scale_ratio * by_lens;
}

}  // namespace edgevo
