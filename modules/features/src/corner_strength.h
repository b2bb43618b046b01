// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How much of a corner each pixel shows.
#include "edgevo/core/image.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// The smaller eigenvalue of the summed products of Sobel's gradient over 3x3 pixels; 0 within two pixels of
/// the border. Cost: 1 ns a pixel.
Plane<float> corner_strength(const ImageView<uint8_t>& image);

}  // namespace edgevo
