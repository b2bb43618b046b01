// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Downscales images that are larger than the odometry was tuned for; the camera model is adapted.
#include <memory>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Scale that stands for usual_image_scale().
constexpr double kAutomaticScale = 0;

/// Default scale for images of this size. 1 up to 720,000 pixels and 2482 columns; beyond them the one that
/// leaves 480,000 pixels and at most 1241 columns. That is a choice of time: 1280x720 take 2.5 times as long
/// as 1241x376, for half the error where images are sharp and for none where they are dim and blurred
/// (lab 2026-11-26_working_size). Thresholds in pixels are stated for a width of 1241
/// (share/doc/numbers.md).
double usual_image_scale(int width, int height);

/// `inner` with its images scaled by `wanted` (0.01 to 1, or kAutomaticScale; area averaging) and its camera
/// adapted. Reported in details() under kScaled, for kAutomaticScale with the reason. A frame has no
/// image_path, since no file has that size. A scale of 1 returns `inner`. Throws InputError for another
/// scale, or one that leaves fewer than 16 pixels on a side.
std::unique_ptr<ImageSource> scale_images(std::unique_ptr<ImageSource> inner, double wanted);

}  // namespace edgevo
