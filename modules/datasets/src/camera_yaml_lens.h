// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The lens of a calibration in YAML: ROS and edgevo name it by distortion_model, Kalibr by camera_model, too,
// OpenCV by fisheye_model, xi or the number of coefficients.
#include <string>

#include "camera_yaml.h"
#include "edgevo/core/camera_models.h"

namespace edgevo {

/// Throws InputError if a lens is named that edgevo does not have.
void check_lens_names(const YamlValues& values, const std::string& where);

/// The lens with its focal lengths and principal point. Throws InputError.
CameraModel lens_of_yaml(const YamlValues& values, const std::string& where);

}  // namespace edgevo
