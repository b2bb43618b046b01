#pragma once
#include <string>
#include <vector>

#include "edgevo/core/image_correction.h"
#include "edgevo/mapping/self_calibration.h"

namespace edgevo {

/// A log line for each thing about the camera that self-calibration has corrected since `before`.
std::vector<std::string> describe_changes(const ImageCorrection& before, const CameraRefinement& now);

}  // namespace edgevo
