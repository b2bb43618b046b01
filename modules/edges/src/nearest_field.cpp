// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/nearest_field.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

constexpr int kShift = NearestField::kShift;  // bits below the squared distance in a key
// A key beyond every distance; adding that of a row does not overflow.
constexpr int16_t kFar = 0x3FFF;

// Sixteen columns; the compiler's vector type, which maps to registers of the available width.
using Keys = int16_t __attribute__((vector_size(32)));
constexpr int kLanes = sizeof(Keys) / sizeof(int16_t);
constexpr int kBlock = 64;  // columns that stay in registers during the loop over the rows
constexpr int kParts = kBlock / kLanes;

// The lowest bit of a key within its row: whether the edge does not lie to the left. So the least of two keys
// at the same distance is that of the left edge. NearestField stores the opposite.
constexpr int16_t kNotLeft = 1;
constexpr int kRampParts = 2;
using Ramp = std::array<Keys, kRampParts>;
static_assert(2 * NearestField::kMaxRadius + 1 <= kRampParts * kLanes);

// Keys in a row around an edge pixel, from `radius` columns before it to `radius` columns after it.
Ramp make_ramp(int radius) {
  std::array<int16_t, kRampParts * kLanes> keys;
  keys.fill(kFar);
  for (int d = -radius; d <= radius; ++d)
    keys[size_t(d + radius)] = int16_t((d * d << kShift) + (d > 0 ? 0 : kNotLeft));
  Ramp ramp;
  std::memcpy(ramp.data(), keys.data(), sizeof(ramp));
  return ramp;
}

// Lets the keys around each edge pixel be at most those of the ramp; `begins`: where a ramp begins.
EDGEVO_WIDE_CLONES void lower_keys(const std::vector<int>& begins, const Ramp& ramp, int16_t* keys) {
  for (const int begin : begins)
    for (int part = 0; part < kRampParts; ++part) {
      int16_t* at = keys + begin + part * kLanes;
      Keys least;
      std::memcpy(&least, at, sizeof(least));
      least = ramp[size_t(part)] < least ? ramp[size_t(part)] : least;
      std::memcpy(at, &least, sizeof(least));
    }
}

// Rows of keys with a margin on both sides, into which ramps at the border reach.
class KeyRows {
 public:
  KeyRows(int width, int height)
      : blocks_((width + kBlock - 1) / kBlock),
        keys_(kMargin + blocks_ * kBlock + kMargin, height),
        is_used_(size_t(blocks_) * size_t(height), 0) {
    std::fill_n(keys_.row(0), size_t(keys_.width()) * size_t(keys_.height()), kFar);
  }
  int blocks() const { return blocks_; }
  int stride() const { return keys_.width(); }
  const int16_t* block(int b) const { return keys_.row(0) + kMargin + b * kBlock; }

  // Notes an edge pixel, which reaches into the blocks `first` and `last`. Returns where its ramp begins.
  int note(int x, int y, int radius, int first, int last) {
    uint8_t* used = &is_used_[size_t(y) * size_t(blocks_)];
    used[first] = used[last] = 1;
    return y * keys_.width() + kMargin + x - radius;
  }
  void lower(const std::vector<int>& begins, int radius) {
    lower_keys(begins, make_ramp(radius), keys_.row(0));
  }
  // Rows in which an edge reaches into a block, in ascending order.
  void list_rows(int block, std::vector<int>* rows) const {
    rows->clear();
    for (int y = 0; y < keys_.height(); ++y)
      if (is_used_[size_t(y) * size_t(blocks_) + size_t(block)]) rows->push_back(y);
  }

 private:
  static constexpr int kMargin = kRampParts * kLanes;
  int blocks_;
  Plane<int16_t> keys_;
  std::vector<uint8_t> is_used_;  // by row and block: whether an edge reaches into it
};

// One block of columns, in all rows.
struct BlockColumn {
  const int16_t* keys;  // of the first row
  int stride;
  const int* rows;  // those with edges
  int row_count;
};

// least[x] = min over the rows [first, last) with edges of their keys + share, which is given by the distance
// in rows from y - radius.
inline void take_minimum(const BlockColumn& c, int first, int last, const int16_t* share, int top,
                         int16_t* out) {
  Keys least[kParts], candidate;
  for (Keys& part : least) part = Keys{} + int16_t(0x7FFF);
  for (int k = first; k < last; ++k) {
    const int16_t* keys = c.keys + std::ptrdiff_t(c.rows[k]) * c.stride;
    for (int part = 0; part < kParts; ++part) {
      std::memcpy(&candidate, keys + part * kLanes, sizeof(Keys));
      candidate += share[c.rows[k] - top];
      least[part] = candidate < least[part] ? candidate : least[part];
    }
  }
  for (Keys& part : least) part ^= kNotLeft;
  std::memcpy(out, least, sizeof(least));
}

// Writes `columns` <= kBlock columns of the field. share: of each distance from -radius to radius.
EDGEVO_WIDE_CLONES void fill_block(const BlockColumn& c, int radius, const int16_t* share, int columns,
                                   int height, int16_t* out, int stride) {
  int first = 0, last = 0;
  for (int y = 0; y < height; ++y, out += stride) {
    while (first < c.row_count && c.rows[first] < y - radius) ++first;
    while (last < c.row_count && c.rows[last] <= y + radius) ++last;
    int16_t best[kBlock];
    take_minimum(c, first, last, share, y - radius, best);
    std::memcpy(out, best, size_t(columns) * sizeof(int16_t));
  }
}

}  // namespace

NearestField::NearestField(const ImageEdges& edges, int radius)
    : radius_(radius),
      none_((radius * radius + 1) << kShift),
      keys_(edges.width, edges.height),
      index_(edges.width, edges.height) {
  const int width = edges.width, height = edges.height;
  KeyRows in_row(width, height);
  // By column: the first and the last block into which an edge pixel reaches.
  std::vector<std::array<int, 2>> reached(size_t(std::max(width, 0)));
  for (int x = 0; x < width; ++x)
    reached[size_t(x)] = {std::max(x - radius, 0) / kBlock,
                          std::min((x + radius) / kBlock, in_row.blocks() - 1)};
  const size_t count = edges.pixels.size();
  std::vector<int> begins(count);
  for (size_t i = 0; i < count; ++i) {
    const EdgePixel& e = edges.pixels[i];
    const int x = std::clamp(int(e.x + 0.5f), 0, width - 1), y = std::clamp(int(e.y + 0.5f), 0, height - 1);
    index_.at(x, y) = int32_t(i);
    begins[i] = in_row.note(x, y, radius, reached[size_t(x)][0], reached[size_t(x)][1]);
  }
  in_row.lower(begins, radius);
  std::vector<int16_t> share;
  for (int dy = -radius; dy <= radius; ++dy)
    share.push_back(int16_t((dy * dy << kShift) + 2 * (dy + radius)));
  std::vector<int> rows;
  for (int b = 0; b < in_row.blocks(); ++b) {
    in_row.list_rows(b, &rows);
    fill_block({in_row.block(b), in_row.stride(), rows.data(), int(rows.size())}, radius, share.data(),
               std::min(kBlock, width - b * kBlock), height, keys_.row(0) + b * kBlock, width);
  }
}

}  // namespace edgevo
