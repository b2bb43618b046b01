// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that every image source runs on each frame before returning it.
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

/// Throws InputError, prefixed with `where` (the frame), when `time` is not after `previous`.
inline void check_time_increases(Timestamp previous, Timestamp time, const std::string& where) {
  if (previous < time) return;
  throw InputError(
      where,
      "its time " + to_string(time) + " s is not after the frame before (" + to_string(previous) + " s)",
      "put the frames in the order of their times, or skip this interval with --frames A:B");
}

}  // namespace edgevo
