#pragma once
// The colours of values in pictures, legends and the map in 3D: one ramp (Turbo), from low to high.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace edgevo {

/// Red, green, blue of 0 to 255.
const std::vector<std::array<uint8_t, 3>>& color_ramp();

/// The same as a CSS gradient from left to right, so that a legend is the ramp itself.
std::string color_ramp_css();

}  // namespace edgevo
