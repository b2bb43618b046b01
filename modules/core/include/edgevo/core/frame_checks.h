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
/// has exactly width * height pixels, and as many values if it has more than 8 bits.
inline void check_pixels(const GrayImage& image, const std::string& where) {
  const bool has_size = image.width >= 0 && image.height >= 0;
  const size_t size = has_size ? size_t(image.width) * size_t(image.height) : 0;
  const std::string named =
      "an image of " + std::to_string(image.width) + "x" + std::to_string(image.height) + " with ";
  if (!has_size || image.pixels.size() != size)
    throw InputError(where, named + std::to_string(image.pixels.size()) + " pixels",
                     "give width * height pixels");
  if (image.is_deep() && image.values.size() != size)
    throw InputError(where, named + std::to_string(image.values.size()) + " values",
                     "give width * height values, or none for 8 bits");
}

}  // namespace edgevo
