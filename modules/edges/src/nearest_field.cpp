// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/nearest_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

constexpr int kShift = NearestField::kShift;  // bits below the squared distance in a key
// A key beyond every distance; adding that of a row does not overflow.
constexpr int16_t kFar = 0x3FFF;

// Keys around one edge pixel of a row, from `radius` columns before it to `radius` columns after it.
std::vector<int16_t> make_ramp(int radius) {
  std::vector<int16_t> keys;
  for (int d = -radius; d <= radius; ++d)
    keys.push_back(int16_t((d * d << kShift) + int(d > 0)));  // after it: the edge lies to the left
  return keys;
}

// One bit per pixel, row by row: it yields the columns of a row in ascending order and once each, without
// sorting.
class EdgeBits {
 public:
  EdgeBits(int width, int height) : words_((width + 63) / 64), bits_(size_t(words_) * height, 0) {}

  void set(int x, int y) { bits_[size_t(y) * words_ + x / 64] |= uint64_t(1) << (x % 64); }
  void list_row(int y, std::vector<int>* xs) const {
    xs->clear();
    const uint64_t* word = &bits_[size_t(y) * words_];
    for (int w = 0; w < words_; ++w)
      for (uint64_t rest = word[w]; rest != 0; rest &= rest - 1)
        xs->push_back(64 * w + __builtin_ctzll(rest));
  }

 private:
  int words_;
  std::vector<uint64_t> bits_;
};

// Writes the key of the nearest edge for each column of one row, given its edges at columns `xs` (ascending).
void fill_row(const std::vector<int>& xs, int width, int radius, const std::vector<int16_t>& ramp,
              int16_t* key) {
  std::fill(key, key + width, kFar);
  for (size_t k = 0; k < xs.size(); ++k) {
    const int left = k == 0 ? 0 : (xs[k - 1] + xs[k]) / 2 + 1;  // a tie goes to the left edge
    const int right = k + 1 == xs.size() ? width - 1 : (xs[k] + xs[k + 1]) / 2;
    const int from = std::max(left, xs[k] - radius), to = std::min(right, xs[k] + radius);
    std::copy_n(ramp.begin() + (from - xs[k] + radius), to - from + 1, key + from);
  }
}

// Sixteen columns; the compiler's vector type, which maps to registers of the available width.
using Keys = int16_t __attribute__((vector_size(32)));
constexpr int kBlock = 64;  // columns that stay in registers during the loop over the rows

// best[x] = min over rows of rows[k][x] + share[k]; `width` is a multiple of kBlock.
EDGEVO_WIDE_CLONES void take_minimum(const int16_t* const* rows, const int16_t* share, int count,
                                     int16_t* best, int width) {
  constexpr int kLanes = sizeof(Keys) / sizeof(int16_t),
                kParts = kBlock / kLanes;  // columns of a register, registers of a block
  for (int x = 0; x < width; x += kBlock) {
    Keys least[kParts], candidate;
    for (Keys& part : least) part = Keys{} + int16_t(0x7FFF);
    for (int k = 0; k < count; ++k)
      for (int part = 0; part < kParts; ++part) {
        std::memcpy(&candidate, rows[k] + x + part * kLanes, sizeof(Keys));
        candidate += share[k];
        least[part] = candidate < least[part] ? candidate : least[part];
      }
    std::memcpy(best + x, least, sizeof(least));
  }
}

}  // namespace

NearestField::NearestField(const ImageEdges& edges, int radius)
    : radius_(radius),
      none_((radius * radius + 1) << kShift),
      keys_(edges.width, edges.height),
      index_(edges.width, edges.height) {
  const int width = edges.width, height = edges.height;
  EdgeBits bits(width, height);
  for (size_t i = 0; i < edges.pixels.size(); ++i) {
    const int x = std::clamp(int(edges.pixels[i].x + 0.5f), 0, width - 1);
    const int y = std::clamp(int(edges.pixels[i].y + 0.5f), 0, height - 1);
    index_.at(x, y) = int32_t(i);
    bits.set(x, y);
  }
  const std::vector<int16_t> ramp = make_ramp(radius);
  const int padded = (width + kBlock - 1) / kBlock * kBlock;
  Plane<int16_t> in_row(padded, height);
  std::vector<int> columns;
  std::vector<bool> is_empty(height);
  for (int y = 0; y < height; ++y) {
    bits.list_row(y, &columns);
    is_empty[y] = columns.empty();
    fill_row(columns, width, radius, ramp, in_row.row(y));
    std::fill(in_row.row(y) + width, in_row.row(y) + padded, kFar);
  }
  std::vector<int16_t> best(padded), share;
  std::vector<const int16_t*> rows;
  for (int y = 0; y < height; ++y) {
    rows.clear(), share.clear();
    for (int dy = std::max(-radius, -y); dy <= std::min(radius, height - 1 - y); ++dy) {
      if (is_empty[y + dy]) continue;
      rows.push_back(in_row.row(y + dy));
      share.push_back(int16_t((dy * dy << kShift) + 2 * (dy + radius)));
    }
    take_minimum(rows.data(), share.data(), int(rows.size()), best.data(), padded);
    std::copy_n(best.begin(), width, keys_.row(y));
  }
}

}  // namespace edgevo
