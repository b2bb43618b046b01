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
  const T* data = nullptr;
  int width = 0, height = 0;
  std::ptrdiff_t stride = 0;

  const T* row(int y) const { return data + y * stride; }
  const T& at(int x, int y) const { return data[y * stride + x]; }
};

/// Gray image, 8 bits, rows without padding.
struct GrayImage {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;  ///< width * height

  bool empty() const { return pixels.empty(); }
  ImageView<uint8_t> view() const { return {pixels.data(), width, height, width}; }
};

/// One image of a sequence, as every source hands it out.
struct Frame {
  int index = 0;   ///< position in the source, from 0; frames left out by --frames or --every keep theirs
  Timestamp time;
  GrayImage image;  ///< as the camera took it, distortion included
  std::string image_path = {};  ///< the file it was read from; empty if it is not a file of its own
};

}  // namespace edgevo
