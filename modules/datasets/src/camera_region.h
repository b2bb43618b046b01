// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of the sensor that the images of a ROS camera show: region of interest (roi) and binning of
// sensor_msgs/CameraInfo, whose matrix and size are those of the whole sensor.
#include <string>

#include "camera_yaml.h"

namespace edgevo {

/// The camera of the images that a file with roi or binning is for; the note says so. A region of zeros, or
/// of the whole image, changes nothing. Throws InputError for a region that is not within the image.
void apply_region(const YamlValues& values, const std::string& where, CameraText* text);

}  // namespace edgevo
