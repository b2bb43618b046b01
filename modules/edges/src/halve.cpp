// SPDX-License-Identifier: BSD-3-Clause
#include "halve.h"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "edgevo/core/simd.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

constexpr int kFilterReach = 2;  // of the filter, pixels

// Mirrors a coordinate at most kFilterReach outside of an image at its first or last pixel; size >
// kFilterReach.
int mirrored(int i, int size) {
  i = std::abs(i);
  return i < size ? i : 2 * (size - 1) - i;
}

// In 16 bits: a sum of five rows is at most 16 * 255, one of five such sums 256 * 255.
EDGEVO_WIDE_CLONES void sum_rows(const uint8_t* __restrict a, const uint8_t* __restrict b,
                                 const uint8_t* __restrict c, const uint8_t* __restrict d,
                                 const uint8_t* __restrict e, uint16_t* __restrict out, int n) {
  for (int i = 0; i < n; ++i) {
    const uint16_t outer = uint16_t(a[i] + e[i]), next = uint16_t(b[i] + d[i]);
    out[i] = uint16_t(outer + 4 * next + 6 * c[i]);
  }
}

EDGEVO_WIDE_CLONES void take_half(const uint16_t* __restrict sums, uint8_t* __restrict out, int n) {
  for (int i = 0; i < n; ++i) {
    const uint16_t* s = sums + 2 * i;
    const uint16_t outer = uint16_t(s[0] + s[4]), next = uint16_t(s[1] + s[3]);
    out[i] = uint8_t(uint16_t(outer + 4 * next + 6 * s[2] + 128) >> 8);
  }
}

}  // namespace

Plane<uint8_t> halve(const Plane<uint8_t>& from, int width, int height) {
  Plane<uint8_t> to(width, height);
  const int from_width = from.width();
  if (std::min(from_width, from.height()) <= kFilterReach) {  // is mirrored more than once
    cv::Mat half = as_mat(to);
    cv::pyrDown(as_mat(from), half, half.size());
    return to;
  }
  std::vector<uint16_t> sums(size_t(kFilterReach + from_width + kFilterReach));
  const auto row = [&](int y) { return from.row(mirrored(y, from.height())); };
  for (int y = 0; y < height; ++y) {
    uint16_t* inside = sums.data() + kFilterReach;
    sum_rows(row(2 * y - 2), row(2 * y - 1), row(2 * y), row(2 * y + 1), row(2 * y + 2), inside, from_width);
    for (int i = 1; i <= kFilterReach; ++i) inside[-i] = inside[mirrored(-i, from_width)];
    for (int i = 0; i < kFilterReach; ++i)
      inside[from_width + i] = inside[mirrored(from_width + i, from_width)];
    take_half(sums.data(), to.row(y), width);
  }
  return to;
}

}  // namespace edgevo
