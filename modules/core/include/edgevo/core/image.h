// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images as plain values: an owned gray image, and a view that owns nothing.
//
// Gray levels have 8 bits: whatever shows, exports or follows an image needs no more. An image of a camera
// with more bits carries the camera's values as well, from which edges and patches are taken.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// View of an image of T, not owned.
template <class T>
struct ImageView {
  /// First element of the first row.
  const T* data = nullptr;
  /// Size in pixels.
  int width = 0, height = 0;
  /// Number of elements from one row to the next.
  std::ptrdiff_t stride = 0;

  /// First element of row y, 0 <= y < height, not checked.
  const T* row(int y) const { return data + y * stride; }
  /// Element at column x and row y, not checked.
  const T& at(int x, int y) const { return data[y * stride + x]; }
};

/// Linear scaling of a camera's values to gray levels: gray = (value - black) / per_level.
struct IntensityScale {
  /// Value that becomes 0.
  double black = 0;
  /// Values per gray level, at least 1.
  double per_level = 256;
};

/// Owned gray image, rows without padding.
struct GrayImage {
  /// Size in pixels.
  int width = 0, height = 0;
  /// Gray levels row by row, width * height of them.
  std::vector<uint8_t> pixels;
  /// Values of a camera with more than 8 bits, in the order of `pixels`, which show them by `scale`, limited
  /// to 0 .. 255. Empty for 8 bits; whoever changes `pixels` clears them.
  std::vector<uint16_t> values = {};
  /// Scaling of `values`, one for all images of a sequence.
  IntensityScale scale = {};

  /// Whether there is no image.
  bool empty() const { return pixels.empty(); }
  /// Whether it has more than 8 bits.
  bool is_deep() const { return !values.empty(); }
  /// View of the gray levels; valid while this object is unchanged.
  ImageView<uint8_t> view() const { return {pixels.data(), width, height, width}; }
};

/// One image of a sequence, as every source returns it.
struct Frame {
  /// Position in the source, from 0; unaffected by --frames and --every.
  int index = 0;
  /// Time of exposure, as the source reports it.
  Timestamp time;
  /// Raw image, with lens distortion.
  GrayImage image;
  /// File of the image; empty if the image does not have a file of its own.
  std::string image_path = {};
};

}  // namespace edgevo
