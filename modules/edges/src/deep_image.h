// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images of more than 8 bits on their way into a pyramid.
#include "edgevo/core/image.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// How the gray levels of one image are spread: gray' = gain * gray + shift.
struct Exposure {
  /// Factor.
  double gain = 1;
  /// Gray levels.
  double shift = 0;
};

/// Exposure of an image of more than 8 bits. 1 and 0 if it uses the scale of its sequence. The gray levels of
/// an image far darker or duller than the scale are spread, but not beyond what its noise allows, so that the
/// thresholds of edges and patches, which are in gray levels, suit it; those of one far brighter are drawn
/// together, so that 16 bits hold them.
Exposure exposure_of(const GrayImage& image);

/// Gray levels of an image of more than 8 bits, in 16-bit pixels (deep_gray.h), after `exposure`.
Plane<uint16_t> deep_gray(const GrayImage& image, const Exposure& exposure);

/// The same in 8 bits, rounded and limited to 0 .. 255.
Plane<uint8_t> shown(const Plane<uint16_t>& gray);

}  // namespace edgevo
