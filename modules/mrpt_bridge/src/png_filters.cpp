// SPDX-License-Identifier: BSD-3-Clause
// A byte needs the one to its left, so a row goes byte by byte. But the row below may follow one byte behind:
// fifteen rows are processed at once, each in a lane of a vector and one byte behind the row above it.
#include "png_filters.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "edgevo/core/simd.h"

// How vectors are passed depends on the target; these functions are only called within this file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edgevo {
namespace {

constexpr int kLanes = 16;
// The first lane repeats the row above the fifteen others.
constexpr int kRows = kLanes - 1;
using Bytes = uint8_t __attribute__((vector_size(kLanes)));

// As numbered in the file; 0: none.
enum class PngFilter : uint8_t { kLeft = 1, kAbove, kMean, kPaeth };

inline Bytes larger(Bytes a, Bytes b) { return a > b ? a : b; }
inline Bytes smaller(Bytes a, Bytes b) { return a < b ? a : b; }
inline Bytes lanes_with(PngFilter filter, const uint8_t* filters) {
  Bytes numbers;
  std::memcpy(&numbers, filters, sizeof(numbers));
  return Bytes(numbers == Bytes{} + uint8_t(filter));
}

// Each lane moved to the one after it; the first becomes 0.
inline Bytes to_next_lane(Bytes v) {
  return __builtin_shufflevector(Bytes{}, v, 0, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
}

// The one of left, above and corner (above left) that is nearest to left + above - corner; the first of
// equals. With low <= high for left and above, the distances are |high - corner| to low, |corner - low| to
// high and the difference of the two to the corner. So low is nearest if 2 (high - corner) <= corner - low,
// and high if 2 (corner - low) <= high - corner. A negative difference counts as 0, which changes neither.
inline Bytes paeth(Bytes left, Bytes above, Bytes corner) {
  const Bytes low = smaller(left, above), high = larger(left, above);
  const Bytes to_high = larger(high, corner) - corner, to_low = corner - smaller(corner, low);
  const Bytes most = larger(to_high, to_low);  // twice a difference might not fit into a byte
  const Bytes nearest = most - to_high >= to_high ? low : corner;
  return most - to_low >= to_low ? high : nearest;
}

struct FilterMasks {
  Bytes left, above, mean, paeth;
};

// Columns of 16 rows of bytes, or back.
inline void transpose(Bytes* rows) {
  Bytes mixed[kLanes];
  const auto interleave = [](const Bytes* from, Bytes* to) {
    for (int i = 0; i < kLanes / 2; ++i) {
      const Bytes a = from[i], b = from[i + kLanes / 2];
      to[2 * i] = __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
      to[2 * i + 1] =
          __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    }
  };
  interleave(rows, mixed), interleave(mixed, rows);
  interleave(rows, mixed), interleave(mixed, rows);
}

// Rows of a batch with zeros before and after them, which a lane meets before and after its row.
class BatchRows {
 public:
  explicit BatchRows(int row_bytes, int most_at_once)
      : stride_(size_t(kLanes) + size_t(row_bytes) + size_t(kLanes) + size_t(most_at_once)),
        bytes_(stride_ * kLanes, 0) {}
  uint8_t* row(int lane) { return &bytes_[stride_ * size_t(lane) + kLanes]; }
  // First byte of the first lane, and how far it is to the byte that the next lane meets at the same time.
  uint8_t* first() { return row(0); }
  std::ptrdiff_t step() const { return std::ptrdiff_t(stride_) - 1; }

 private:
  size_t stride_;
  std::vector<uint8_t> bytes_;
};

// in, out: of the first lane; step: from there to the next one.
template <int kChannels>
EDGEVO_WIDE_CLONES void unfilter_batch(const FilterMasks& is, const uint8_t* in, std::ptrdiff_t step,
                                       int row_bytes, uint8_t* out) {
  Bytes left[kChannels] = {}, corner[kChannels] = {}, newest{}, columns[kChannels][kLanes];
  for (int x = 0; x < row_bytes + kRows; x += kChannels * kLanes) {
    for (int c = 0; c < kChannels; ++c) {
      for (int lane = 0; lane < kLanes; ++lane)
        std::memcpy(&columns[c][lane], in + x + c * kLanes + lane * step, sizeof(Bytes));
      transpose(columns[c]);
    }
    Bytes* column = columns[0];
    for (int pixel = 0; pixel < kLanes; ++pixel)
      for (int c = 0; c < kChannels; ++c, ++column) {
        const Bytes above = to_next_lane(newest);
        const Bytes mean = (left[c] & above) + ((left[c] ^ above) >> 1);
        newest = *column + ((is.left & left[c]) | (is.above & above) | (is.mean & mean) |
                            (is.paeth & paeth(left[c], above, corner[c])));
        *column = left[c] = newest;
        corner[c] = above;
      }
    for (int c = 0; c < kChannels; ++c) {
      transpose(columns[c]);
      for (int lane = 0; lane < kLanes; ++lane)
        std::memcpy(out + x + c * kLanes + lane * step, &columns[c][lane], sizeof(Bytes));
    }
  }
}

}  // namespace

bool unfilter_rows(const uint8_t* rows, int row_count, int row_bytes, int channels, uint8_t* pixels,
                   std::ptrdiff_t stride) {
  BatchRows in(row_bytes, channels * kLanes), out(row_bytes, channels * kLanes);
  for (int y = 0; y < row_count; y += kRows) {
    uint8_t filters[kLanes] = {};
    if (y > 0) std::copy_n(pixels + (y - 1) * stride, row_bytes, in.row(0));
    const int count = std::min(kRows, row_count - y);
    for (int k = 0; k < count; ++k) {
      const uint8_t* row = rows + std::ptrdiff_t(y + k) * (row_bytes + 1);
      if (row[0] > uint8_t(PngFilter::kPaeth)) return false;
      filters[k + 1] = row[0];
      std::copy_n(row + 1, row_bytes, in.row(k + 1));
    }
    const FilterMasks masks{lanes_with(PngFilter::kLeft, filters), lanes_with(PngFilter::kAbove, filters),
                            lanes_with(PngFilter::kMean, filters), lanes_with(PngFilter::kPaeth, filters)};
    (channels == 1 ? unfilter_batch<1> : unfilter_batch<3>)(masks, in.first(), in.step(), row_bytes,
                                                            out.first());
    for (int k = 0; k < count; ++k) std::copy_n(out.row(k + 1), row_bytes, pixels + (y + k) * stride);
  }
  return true;
}

}  // namespace edgevo
