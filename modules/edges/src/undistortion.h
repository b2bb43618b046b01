#pragma once
// An image as a pinhole would have seen it: each pixel fetched from where the lens put it.
#include <cstdint>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Bilinear, positions rounded to 1/128 px; beyond the border the border pixels go on. At least 2x2 pixels.
/// Faster than OpenCV's remap, whose positions are rounded to 1/32 px (numbers in the module's README).
class Undistortion {
 public:
  explicit Undistortion(const UndistortionMaps& maps);
  /// `image` and `out` have the size of the maps.
  void apply(const ImageView<uint8_t>& image, Plane<uint8_t>* out) const;

 private:
  int width_, height_;
  std::vector<int32_t> corner_;        // per pixel: upper left of the four around its position, x + y * width
  std::vector<uint8_t> right_, down_;  // from there, in 1/128 px, 0..128
};

}  // namespace edgevo
