// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The move of a map whose unit of length is set back after a doubt.
#include "edgevo/map/map.h"

namespace edgevo {

/// Multiplies all lengths after keyframe `last_sure` by `scale_ratio`: poses, depths, and the distance from
/// it. The keyframes up to it keep their shape and follow; the newest keyframe stays where it is. The map
/// must have active keyframes.
MapMoved move_of_unit(const Map& map, int last_sure, double scale_ratio);

}  // namespace edgevo
