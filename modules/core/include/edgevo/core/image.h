#pragma once
// Images as plain values: an owned 8-bit gray image, and a view that owns nothing.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Rows of T that somebody else owns; `stride` counts elements from row to row.
template <class T>
struct ImageView {
  const T* data = nullptr;  ///< first element of the first row
  int width = 0, height = 0;  ///< pixels
  std::ptrdiff_t stride = 0;  ///< elements from one row to the next

  const T* row(int y) const { return data + y * stride; }  ///< 0 <= y < height, not checked
  const T& at(int x, int y) const { return data[y * stride + x]; }  ///< inside the image, not checked
};

/// Gray image, 8 bits, rows without padding.
struct GrayImage {
  int width = 0, height = 0;  ///< pixels
  std::vector<uint8_t> pixels;  ///< width * height

  bool empty() const { return pixels.empty(); }  ///< no image
  /// valid while this object is unchanged
  ImageView<uint8_t> view() const { return {pixels.data(), width, height, width}; }
};

/// One image of a sequence, as every source hands it out.
struct Frame {
  int index = 0;   ///< position in the source, from 0; frames left out by --frames or --every keep theirs
  Timestamp time;  ///< of the exposure, as the source tells it
  GrayImage image;  ///< as the camera took it, distortion included
  std::string image_path = {};  ///< the file it was read from; empty if it is not a file of its own
};

}  // namespace edgevo
