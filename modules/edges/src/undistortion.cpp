// SPDX-License-Identifier: BSD-3-Clause
#include "undistortion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

// One pixel in units of the fractions: products of two fractions and a pixel of 16 bits fit 32 bits.
constexpr int kOne = 128;
// Number of pixels gathered, then blended, at a time, so that they stay in the L1 cache.
constexpr int kRunLength = 256;

// Two neighbours in a row, the left one first.
template <class T>
struct Pair {
  T left, right;
};
template <class T>
using Pairs = std::array<Pair<T>, kRunLength>;

template <class T>
EDGEVO_WIDE_CLONES void blend(const Pairs<T>& above, const Pairs<T>& below, const uint8_t* right,
                              const uint8_t* down, int count, T* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const int x = right[i], y = down[i];
    const int top = above[i].left * (kOne - x) + above[i].right * x;
    const int bottom = below[i].left * (kOne - x) + below[i].right * x;
    out[i] = T((top * (kOne - y) + bottom * y + kOne * kOne / 2) / (kOne * kOne));
  }
}

// Defined also for NaN, which a lens model may give.
float within(float position, int size) { return std::min(std::max(0.0f, position), float(size - 1)); }

// Samples one row: fetches the neighbours of each position and blends them.
template <class T>
void fetch_run(const ImageView<T>& image, const int32_t* corner, const uint8_t* right, const uint8_t* down,
               int count, T* out) {
  Pairs<T> above, below;
  for (int i = 0; i < count; ++i) {
    const T* p = image.data + corner[i];
    std::memcpy(&above[i], p, sizeof(above[i]));
    std::memcpy(&below[i], p + image.width, sizeof(below[i]));
  }
  blend(above, below, right, down, count, out);
}

// A run of positions in the raw image, as corners and fractions.
struct Run {
  std::array<float, kRunLength> x, y;
  std::array<int32_t, kRunLength> corner;
  std::array<uint8_t, kRunLength> right, down;
};

EDGEVO_WIDE_CLONES void split_positions(int count, int width, int height, Run* __restrict r) {
  const float last_x = float(width - 1), last_y = float(height - 1);
  for (int i = 0; i < count; ++i) {
    const float x = std::min(std::max(0.0f, r->x[i]), last_x), y = std::min(std::max(0.0f, r->y[i]), last_y);
    const int left = std::min(int(x), width - 2), top = std::min(int(y), height - 2);
    r->corner[i] = left + top * width;
    r->right[i] = uint8_t(int((x - float(left)) * kOne + 0.5f));
    r->down[i] = uint8_t(int((y - float(top)) * kOne + 0.5f));
  }
}

// Shift of one row of the image at the columns of the nodes.
std::vector<float> between_rows(const float* above, const float* below, float share, int columns) {
  std::vector<float> row(columns);
  for (int k = 0; k < columns; ++k) row[k] = above[k] + share * (below[k] - above[k]);
  return row;
}

// position + shift, with the shift interpolated between the node `x` / kCell and the next one.
void add_shift(const float* position, const std::vector<float>& shift, int x, int count, float* out) {
  constexpr int kCell = ShiftGrid::kCell;  // pixels
  for (int first = 0; first < count; first += kCell) {
    const int node = (x + first) / kCell, n = std::min(kCell, count - first);
    const float from = shift[node], slope = (shift[node + 1] - from) / kCell;
    for (int i = 0; i < n; ++i) out[first + i] = position[first + i] + (from + slope * float(i));
  }
}

}  // namespace

Undistortion::Undistortion(const RectificationMaps& maps, int width, int height)
    : width_(maps.width), height_(maps.height) {
  const size_t size = size_t(width_) * height_;
  corner_.reserve(size), right_.reserve(size), down_.reserve(size);
  for (size_t i = 0; i < size; ++i) {
    const float x = within(maps.x[i], width), y = within(maps.y[i], height);
    const int left = std::min(int(x), width - 2), top = std::min(int(y), height - 2);
    corner_.push_back(left + top * width);
    right_.push_back(uint8_t(std::lround((x - float(left)) * kOne)));
    down_.push_back(uint8_t(std::lround((y - float(top)) * kOne)));
  }
}

template <class T>
void Undistortion::apply(const ImageView<T>& image, Plane<T>* out) const {
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; x += kRunLength) {
      const size_t first = size_t(y) * width_ + x;
      fetch_run(image, &corner_[first], &right_[first], &down_[first], std::min(kRunLength, width_ - x),
                out->row(y) + x);
    }
}

template <class T>
void ShiftedUndistortion::apply(const ShiftGrid& shift, const ImageView<T>& image, Plane<T>* out) const {
  static_assert(kRunLength % ShiftGrid::kCell == 0, "runs begin at nodes");
  const int width = maps_.width, height = maps_.height;
  Run run;
  for (int y = 0; y < height; ++y) {
    const int node = y / ShiftGrid::kCell;
    const float share = float(y % ShiftGrid::kCell) / ShiftGrid::kCell;
    const std::vector<float> dx = between_rows(shift.x(node), shift.x(node + 1), share, shift.columns());
    const std::vector<float> dy = between_rows(shift.y(node), shift.y(node + 1), share, shift.columns());
    for (int x = 0; x < width; x += kRunLength) {
      const size_t first = size_t(y) * width + x;
      const int count = std::min(kRunLength, width - x);
      add_shift(&maps_.x[first], dx, x, count, run.x.data());
      add_shift(&maps_.y[first], dy, x, count, run.y.data());
      split_positions(count, image.width, image.height, &run);
      fetch_run(image, run.corner.data(), run.right.data(), run.down.data(), count, out->row(y) + x);
    }
  }
}

template void Undistortion::apply(const ImageView<uint8_t>&, Plane<uint8_t>*) const;
template void Undistortion::apply(const ImageView<uint16_t>&, Plane<uint16_t>*) const;
template void ShiftedUndistortion::apply(const ShiftGrid&, const ImageView<uint8_t>&, Plane<uint8_t>*) const;
template void ShiftedUndistortion::apply(const ShiftGrid&, const ImageView<uint16_t>&,
                                         Plane<uint16_t>*) const;

}  // namespace edgevo
