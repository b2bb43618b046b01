// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "edgevo/calibration/calibrate_camera.h"

namespace edgevo {

/// What the views do not cover, a sentence each: parts of the image without a corner (the lens is
/// extrapolated there) and missing tilts of the board (without which focal length and distance are hard to
/// separate).
std::vector<std::string> what_is_lacking(const std::vector<ViewFit>& views, int width, int height);

/// True if the board is tilted by 15 degrees or more in some view. For frontal views a larger focal length
/// looks like a larger distance.
bool is_tilted(const std::vector<ViewFit>& views);

}  // namespace edgevo
