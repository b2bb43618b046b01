// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace edgevo {

/// Largest width or height in pixels that image formats hold.
constexpr int kLargestSide = 65535;

/// A width or height as a whole number of pixels. Throws InputError opened by `where`.
int image_side(double value, const std::string& where);

}  // namespace edgevo
