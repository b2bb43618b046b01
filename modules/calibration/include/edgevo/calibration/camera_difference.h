// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether two descriptions of a camera mean the same.
#include "edgevo/core/camera.h"

namespace edgevo {

/// Largest distance, pixels, between the pixels at which two cameras of the same image size show the same
/// direction, over a grid of pixels of `a`. Infinite where only one of them shows a direction. Cost: some
/// hundred projections.
double largest_difference_px(const Camera& a, const Camera& b);

}  // namespace edgevo
