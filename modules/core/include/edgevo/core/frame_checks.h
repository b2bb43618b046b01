// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks of images: by every source on each frame before returning it, and by whatever takes an image.
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/error.h"
#include "edgevo/core/image.h"

namespace edgevo {

/// Throws InputError, prefixed with `where` (the image), when the image's size differs from the camera's.
inline void check_image_size(const GrayImage& image, const Pinhole& camera, const std::string& where) {
  if (image.width == camera.width && image.height == camera.height) return;
  throw InputError(where,
                   "the image is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                       ", but the camera model is for " + std::to_string(camera.width) + "x" +
                       std::to_string(camera.height),
                   "give the calibration of these images (--camera)");
}

/// Throws InputError, prefixed with `where` (the image or the function that was given it), unless the image
/// has exactly width * height pixels.
inline void check_pixels(const GrayImage& image, const std::string& where) {
  const bool has_size = image.width >= 0 && image.height >= 0;
  if (has_size && image.pixels.size() == size_t(image.width) * size_t(image.height)) return;
  throw InputError(where,
                   "an image of " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                       " with " + std::to_string(image.pixels.size()) + " pixels",
                   "give width * height pixels");
}

}  // namespace edgevo
