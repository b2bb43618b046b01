// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Unit of the gray levels that a pyramid of more than 8 bits holds in 16-bit pixels:
//
//   gray level = kDeepBlack + pixel / kDeepSteps
//
// so that thresholds in gray levels hold for any depth. There is room below black and above 255, since the
// scaling of a sequence is decided from its first images.
#include <cstdint>

namespace edgevo {

/// Steps of a 16-bit pixel per gray level.
constexpr int kDeepSteps = 128;
/// Gray level of a 16-bit pixel of value 0.
constexpr int kDeepBlack = -128;
/// Gray level of the largest 16-bit pixel, rounded down.
constexpr int kDeepWhite = kDeepBlack + 65535 / kDeepSteps;

/// Gray levels per step of a pixel type; 1 for 8 bits, and for gradients. Differences of pixels, and values
/// of patches that are compared with each other, times this are in gray levels.
template <class T>
constexpr float kGrayPerStep = 1.0f;
/// The same for pixels of 16 bits.
template <>
inline constexpr float kGrayPerStep<uint16_t> = 1.0f / kDeepSteps;

}  // namespace edgevo
