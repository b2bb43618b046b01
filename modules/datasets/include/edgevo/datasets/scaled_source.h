#pragma once
// Images that are larger than the odometry was made for, made smaller; the camera model follows.
#include <memory>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// The scale at which images of this width are worked on: 1 up to 2482 px, beyond that the one that makes
/// them 1241 px wide. 1241 is what accuracy and time were measured with and thresholds in pixels are stated
/// for (share/doc/numbers.md); more than twice that, a whole pyramid level, is where poses began to be lost
/// (share/lab/archive/2026-11-24_image_scale.md).
double usual_image_scale(int width);

/// `inner` with its images scaled by `scale` (0.01 to 1; areas are averaged), and with the camera of these.
/// Told in details() under kScaled. A frame has no image_path: there is no file of that size. `scale` 1:
/// `inner` itself. Throws InputError for another scale, or one that leaves fewer than 16 pixels of a side.
std::unique_ptr<ImageSource> scale_images(std::unique_ptr<ImageSource> inner, double scale);

}  // namespace edgevo
