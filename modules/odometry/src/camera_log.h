#pragma once
// What the log says about the camera.
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

/// A log line for each thing about the camera that self-calibration has corrected since `before`.
std::vector<std::string> describe_changes(const ImageCorrection& before, const CameraRefinement& now);
/// A log line on images of which `share`, 0 to 1, is never lit.
std::string describe_border_mask(double share);

}  // namespace edgevo
