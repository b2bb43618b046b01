#pragma once
#include <string>

namespace edgevo {

/// A width or height as a whole number of pixels. Throws InputError opened by `where`.
int image_side(double value, const std::string& where);

}  // namespace edgevo
