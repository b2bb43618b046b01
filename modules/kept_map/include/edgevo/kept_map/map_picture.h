// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/kept_map/kept_map.h"

namespace edgevo {

/// Draws a map from above: points, the path of the keyframes, and the places seen again. Forward at the first
/// keyframe is up. Returns the bytes of a PNG, at most 1,200 pixels wide and high. Of a run that was killed
/// the segments lie on top of one another.
std::string map_picture(const KeptMap& map);

}  // namespace edgevo
