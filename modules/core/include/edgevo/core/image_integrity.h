#pragma once
// Is an encoded image whole? The decoders tell only part of it: libjpeg pads a cut image with gray and
// succeeds, libpng prints to stderr.
#include <string>
#include <string_view>

namespace edgevo {

/// Empty if `bytes` is a whole PNG or JPEG, or another format (not checked); else what is wrong with it.
std::string image_damage(std::string_view bytes);

}  // namespace edgevo
