#pragma once
#include <string>

namespace edgevo {

constexpr int kLargestSide = 65535;  ///< pixels of a width or height: what image formats hold

/// A width or height as a whole number of pixels. Throws InputError opened by `where`.
int image_side(double value, const std::string& where);

}  // namespace edgevo
