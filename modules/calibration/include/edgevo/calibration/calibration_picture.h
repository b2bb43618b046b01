#pragma once
#include <string>

#include "edgevo/calibration/calibrate_camera.h"

namespace edgevo {

/// A PNG of the image's area with every corner of every view and its residual, drawn so many times too long
/// that they can be seen (the picture says how many), one colour a view: where corners are missing the lens
/// is a guess, and residuals that point the same way in one place are what the model does not hold.
std::string calibration_picture(const CameraCalibration& calibration);

}  // namespace edgevo
