// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images as plain values: an owned 8-bit gray image, and a view that owns nothing.
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

/// Owned gray image, 8 bits, rows without padding.
struct GrayImage {
  /// Size in pixels.
  int width = 0, height = 0;
  /// Intensities row by row, width * height of them.
  std::vector<uint8_t> pixels;

  /// Whether there is no image.
  bool empty() const { return pixels.empty(); }
  /// View of this image; valid while this object is unchanged.
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
