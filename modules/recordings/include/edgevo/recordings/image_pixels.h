// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Pixels of sensor_msgs/Image as a gray image.
//
// Colour becomes gray by the weights of an image file that is read as gray (mrpt_bridge/image_file.h): the
// same pixels give the same bytes. YUV: its luma. Bayer: OpenCV's bilinear interpolation.
#include <string>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/recordings/messages.h"

namespace edgevo {

/// The encodings that are read: "mono8", "mono16", "rgb8", ...
std::vector<std::string> image_encodings();

/// The image. One of more than 8 bits has `values` and no `pixels`: their scaling is that of the sequence.
/// Throws InputError, opened by `where`: an encoding that is not read, by its name; no pixels, or fewer than
/// size and step say.
GrayImage gray_image(const ImageMessage& message, const std::string& where);

}  // namespace edgevo
