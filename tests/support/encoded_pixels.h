// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gray images as the pixels of each encoding of sensor_msgs/Image, and a Bayer pattern as colours. Shares
// nothing with what reads them.
//
// mono8, rgb8, bgr8, rgba8, bgra8, yuv422, yuv422_yuy2: of pixels that are coloured and have this gray;
// mono16, 16UC1: 256 times the gray; bayer_*8: the image itself as the pattern, so that another gray is read.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "edgevo/core/image.h"

namespace edgevo::test {

using Rgb = std::array<int, 3>;

/// Distance of the gray of a colour (ITU-R BT.601) from `gray`.
inline double gray_error(const Rgb& c, int gray) {
  return std::abs(0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2] - gray);
}

/// A colour whose gray is `gray` by any rounding: blue far from red, as far as there is room.
inline Rgb colour_of(int gray) {
  constexpr double kSure = 0.2;
  for (int blue = 60; blue > 0; --blue) {
    const int red = -int(std::lround(0.114 / 0.299 * blue));
    const Rgb colour{gray + red, gray, gray + blue};
    if (colour[0] >= 0 && colour[2] <= 255 && gray_error(colour, gray) < kSure) return colour;
  }
  return {gray, gray, gray};
}

/// The bytes of one pixel.
inline std::string encoded_pixel(int gray, const std::string& encoding) {
  const Rgb c = colour_of(gray);
  const std::string rgb{char(c[0]), char(c[1]), char(c[2])}, bgr{char(c[2]), char(c[1]), char(c[0])};
  constexpr char kAlpha = 77, kChroma = 90;
  if (encoding == "rgb8") return rgb;
  if (encoding == "bgr8") return bgr;
  if (encoding == "rgba8") return rgb + kAlpha;
  if (encoding == "bgra8") return bgr + kAlpha;
  if (encoding == "yuv422") return {kChroma, char(gray)};
  if (encoding == "yuv422_yuy2") return {char(gray), kChroma};
  if (encoding == "mono16" || encoding == "16UC1") return {'\0', char(gray)};
  return {char(gray)};
}

/// The bytes of an image.
inline std::string encoded(const GrayImage& image, const std::string& encoding) {
  std::array<std::string, 256> bytes;
  for (int gray = 0; gray < 256; ++gray) bytes[size_t(gray)] = encoded_pixel(gray, encoding);
  std::string data;
  for (const uint8_t pixel : image.pixels) data += bytes[pixel];
  return data;
}

/// Values of 16 bits in the other order of their bytes.
inline std::string big_endian(std::string values) {
  for (size_t i = 0; i + 1 < values.size(); i += 2) std::swap(values[i], values[i + 1]);
  return values;
}

/// "rggb" of "bayer_rggb8".
inline std::string pattern_of(const std::string& encoding) { return encoding.substr(6, 4); }

/// The mean, rounded, of what neighbours of (x, y) in the pattern show of one colour: of the pixel itself,
/// else of those next to it, else of those at its corners.
inline int bilinear(const GrayImage& raw, const std::string& pattern, int x, int y, char colour) {
  const auto is = [&](int u, int v) { return pattern[size_t(v % 2 * 2 + u % 2)] == colour; };
  const auto at = [&](int u, int v) { return int(raw.pixels[size_t(v) * size_t(raw.width) + size_t(u)]); };
  if (is(x, y)) return at(x, y);
  int sum = 0, count = 0;
  for (int reach = 1; count == 0; ++reach)  // in columns and rows together
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (std::abs(dx) + std::abs(dy) == reach && is(x + dx, y + dy)) sum += at(x + dx, y + dy), ++count;
  return (sum + count / 2) / count;
}

/// Colours of a Bayer pattern by bilinear interpolation, three bytes a pixel; those of the border are those
/// of the pixel next to it.
inline std::string rgb_of_bayer(const GrayImage& raw, const std::string& pattern) {
  std::string rgb;
  for (int y = 0; y < raw.height; ++y)
    for (int x = 0; x < raw.width; ++x)
      for (const char colour : {'r', 'g', 'b'})
        rgb += char(bilinear(raw, pattern, std::min(std::max(x, 1), raw.width - 2),
                             std::min(std::max(y, 1), raw.height - 2), colour));
  return rgb;
}

}  // namespace edgevo::test
