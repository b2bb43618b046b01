// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The images of one topic of a recording of ROS, as an ImageSource.
//
// Times are the stamps of the headers; as recorded where these are 0. The camera is that of CameraInfo, the
// mount that of /tf_static in base_link. Opening reads the first images; times() reads the heads of all.
#include <memory>
#include <string>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// Opens the source. Throws InputError: see open_recording() and choose_image_topic(); no calibration.
std::unique_ptr<ImageSource> open_recording_source(const SourceOptions& options);

}  // namespace edgevo
