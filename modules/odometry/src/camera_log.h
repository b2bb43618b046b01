// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Log lines about the camera.
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

/// One log line for each property of the camera that self-calibration has corrected since `before`.
std::vector<std::string> describe_changes(const ImageCorrection& before, const CameraPosterior& now);
/// Log line for images of which a share, 0 to 1, never receives light.
std::string describe_border_mask(double share);

}  // namespace edgevo
