// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The colour ramp (Turbo) of pictures, legends and the map in 3D.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace edgevo {

/// 256 colours from low to high, each red, green, blue from 0 to 255.
const std::vector<std::array<uint8_t, 3>>& color_ramp();

/// The ramp as a CSS gradient from left to right, for legends.
std::string color_ramp_css();

}  // namespace edgevo
