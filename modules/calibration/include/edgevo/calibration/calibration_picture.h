// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/calibration/calibrate_camera.h"

namespace edgevo {

/// A PNG of the image area with every corner of every view and its residual, magnified so that it is visible
/// (the caption states the factor), one colour for each view. Where corners are missing the lens is
/// extrapolated; residuals that agree in direction show what the model cannot represent.
std::string calibration_picture(const CameraCalibration& calibration);

}  // namespace edgevo
