// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Canny edge detection on a given gradient.
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// Edge mask, 255 at edge pixels: where the magnitude is a maximum across the edge (direction rounded to 45
/// degrees) and above `high`, or above `low` and linked to such a pixel; thresholds in Sobel units. The
/// outermost pixels of the image are never edges. Cost: about 1.5 ms at 1241x376.
Plane<uint8_t> canny(const Gradient& gradient, float low, float high);

/// Mark of a pixel that counts only if it is linked to a strong one.
constexpr uint8_t kWeakMark = 1;
/// Mark of a strong pixel.
constexpr uint8_t kStrongMark = 255;
/// Hysteresis: weak pixels that are linked to a strong one become strong, the others 0. The outermost pixels
/// must be 0.
void keep_linked(Plane<uint8_t>* mask);

}  // namespace edgevo
