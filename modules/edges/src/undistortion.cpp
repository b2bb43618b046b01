#include "undistortion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

constexpr int kOne = 128;        // a pixel in the units of the fractions: products of two and a gray level fit 32 bits
constexpr int kRunLength = 256;  // pixels gathered, then blended, at a time

// Two neighbours in a row, the left one first.
struct Pair {
  uint8_t left, right;
};
using Pairs = std::array<Pair, kRunLength>;

EDGEVO_WIDE_CLONES void blend(const Pairs& above, const Pairs& below, const uint8_t* right, const uint8_t* down, int count,
                              uint8_t* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const int x = right[i], y = down[i];
    const int top = above[i].left * (kOne - x) + above[i].right * x;
    const int bottom = below[i].left * (kOne - x) + below[i].right * x;
    out[i] = uint8_t((top * (kOne - y) + bottom * y + kOne * kOne / 2) / (kOne * kOne));
  }
}

// Also where a lens model gives no number.
float within(float position, int size) { return std::min(std::max(0.0f, position), float(size - 1)); }

}  // namespace

Undistortion::Undistortion(const UndistortionMaps& maps) : width_(maps.width), height_(maps.height) {
  const size_t size = size_t(width_) * height_;
  corner_.reserve(size), right_.reserve(size), down_.reserve(size);
  for (size_t i = 0; i < size; ++i) {
    const float x = within(maps.x[i], width_), y = within(maps.y[i], height_);
    const int left = std::min(int(x), width_ - 2), top = std::min(int(y), height_ - 2);
    corner_.push_back(left + top * width_);
    right_.push_back(uint8_t(std::lround((x - float(left)) * kOne)));
    down_.push_back(uint8_t(std::lround((y - float(top)) * kOne)));
  }
}

void Undistortion::apply(const ImageView<uint8_t>& image, Plane<uint8_t>* out) const {
  Pairs above, below;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; x += kRunLength) {
      const size_t first = size_t(y) * width_ + x;
      const int count = std::min(kRunLength, width_ - x);
      for (int i = 0; i < count; ++i) {
        const uint8_t* p = image.data + corner_[first + i];
        std::memcpy(&above[i], p, 2);
        std::memcpy(&below[i], p + width_, 2);
      }
      blend(above, below, &right_[first], &down_[first], count, out->row(y) + x);
    }
}

}  // namespace edgevo
