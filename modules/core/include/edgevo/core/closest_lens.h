// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// For programs that do not know a lens: the closest one of a kind that many know.
#include "edgevo/core/camera.h"

namespace edgevo {

/// A camera whose lens is used for that of another one.
struct ClosestLens {
  /// With the same size, focal lengths and principal point.
  Camera camera;
  /// Largest distance between the pixels of both for a ray, over the image; 0: the same lens.
  double max_error_px = 0;
};

/// The Kannala-Brandt lens that fits best over the image of `camera`, by least squares in pixels; the camera
/// itself if it has that lens. Cost: some 2,500 inversions.
ClosestLens closest_kannala_brandt(const Camera& camera);

}  // namespace edgevo
