#pragma once
// Is an encoded image whole? The decoders tell only part of it: libjpeg pads a cut image with gray and
// succeeds; libpng, and OpenCV's own decoders, print to stderr.
#include <string>
#include <string_view>

namespace edgevo {

/// Empty if `bytes` is a whole PNG, JPEG, BMP or PNM, or another format (not checked); else what is wrong
/// with it. No pixel is decoded: a header that promises a giant costs nothing.
std::string image_damage(std::string_view bytes);

}  // namespace edgevo
