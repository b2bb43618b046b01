// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "grabber.h"

namespace edgevo {

/// A grabber over mrpt::hwdrivers::CCameraSensor: opencv, ffmpeg, image_dir, dc1394, kinect, ... The mount is
/// the section's pose_x ... pose_roll; the time of an image is its time of arrival unless the driver provides
/// one. Throws InputError.
std::unique_ptr<Grabber> open_camera_sensor(const mrpt::config::CConfigFileBase& config,
                                            const std::string& section, const std::string& calibration_file);

}  // namespace edgevo
