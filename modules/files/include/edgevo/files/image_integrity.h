// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that an encoded image is complete. Decoders are not reliable here: libjpeg pads a truncated image
// with gray and succeeds; libpng and the decoders of OpenCV print to stderr.
#include <string>
#include <string_view>

namespace edgevo {

/// Describes the damage of a PNG, JPEG, BMP or PNM; empty if it is complete or in another format (not
/// checked). No pixel is decoded: a header with a huge size costs nothing.
std::string image_damage(std::string_view bytes);

}  // namespace edgevo
