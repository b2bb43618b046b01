// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Downscales images that are larger than the odometry was tuned for; the camera model is adapted.
#include <memory>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Default scale for images of this width: 1 up to 2482 px, beyond that the one that makes them 1241 px wide.
/// Accuracy and time were measured at 1241, and thresholds in pixels are stated for it
/// (share/doc/numbers.md); beyond twice that, a full pyramid level, poses began to be lost
/// (share/lab/archive/2026-11-24_image_scale.md).
double usual_image_scale(int width);

/// `inner` with its images scaled by `scale` (0.01 to 1; area averaging) and its camera adapted. Reported in
/// details() under kScaled. A frame has no image_path, since no file has that size. `scale` 1 returns
/// `inner`. Throws InputError for another scale, or one that leaves fewer than 16 pixels on a side.
std::unique_ptr<ImageSource> scale_images(std::unique_ptr<ImageSource> inner, double scale);

}  // namespace edgevo
