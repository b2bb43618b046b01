#pragma once
#include <string>
#include <vector>

#include "edgevo/calibration/calibrate_camera.h"

namespace edgevo {

/// What the views leave unseen, a sentence each: parts of the image without a corner (its lens is a guess
/// there) and tilts of the board that are missing (focal length and distance are then hard to tell apart).
std::vector<std::string> what_is_lacking(const std::vector<ViewFit>& views, int width, int height);

/// In some view the board is tilted by 15 degrees or more. Straight on, a larger focal length looks like a
/// larger distance.
bool is_tilted(const std::vector<ViewFit>& views);

}  // namespace edgevo
