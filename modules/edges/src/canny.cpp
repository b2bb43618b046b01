// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/canny.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

constexpr uint8_t kWeak = kWeakMark, kEdge = kStrongMark;  // in the mask: over `low`, over `high`

// One row of maxima across the edge: kEdge above `high`, kWeak above `low`, 0 otherwise. The direction of the
// gradient, rounded to 45 degrees, selects the two neighbours to compare with. All four pairs are compared
// for every pixel: without branches, eight pixels are processed at a time.
EDGEVO_WIDE_CLONES void mark_maxima(const float* above, const float* m, const float* below, const int16_t* dx,
                                    const int16_t* dy, float low, float high, uint8_t* __restrict mask,
                                    int width) {
  // tan 22.5 degrees, the boundary between two of the 45 degree directions.
  constexpr float kTan22 = 0.41421356f;
  for (int x = 1; x < width - 1; ++x) {
    const float gx = dx[x], gy = dy[x], ax = std::abs(gx), ay = std::abs(gy), at = m[x];
    const int across = int(at > m[x - 1]) & int(at >= m[x + 1]);
    const int down = int(at > above[x]) & int(at >= below[x]);
    const int falling = int(at > above[x - 1]) & int(at >= below[x + 1]);
    const int rising = int(at > above[x + 1]) & int(at >= below[x - 1]);
    const int along_row = int(ay < kTan22 * ax), along_column = int(ax < kTan22 * ay),
              falls = int(gx * gy > 0);
    const int diagonal = (falls & falling) | ((1 - falls) & rising);
    const int oblique = (1 - along_row) & (1 - along_column);
    const int is_maximum = (along_row & across) | (along_column & down) | (oblique & diagonal);
    mask[x] = uint8_t((is_maximum & int(at > low)) * (kWeak + (kEdge - kWeak) * int(at > high)));
  }
}

// Positions of the marks in the mask. Most of it is empty, so eight pixels are tested at a time.
struct Maxima {
  std::vector<int> weak, strong;

  explicit Maxima(const Plane<uint8_t>& mask) {
    const int size = mask.width() * mask.height();
    const uint8_t* m = mask.row(0);
    weak.reserve(size / 16), strong.reserve(size / 16);
    for (int at = 0; at < size; at += 8) {
      uint64_t eight = 0;
      std::memcpy(&eight, m + at, size_t(std::min(8, size - at)));
      if (eight == 0) continue;
      for (int i = at; i < std::min(at + 8, size); ++i)
        if (m[i]) (m[i] == kEdge ? strong : weak).push_back(i);
    }
  }
};

}  // namespace

Plane<uint8_t> canny(const Gradient& gradient, float low, float high) {
  const int width = gradient.magnitude.width(), height = gradient.magnitude.height();
  Plane<uint8_t> mask(width, height);
  uint8_t* const m = mask.row(0);
  std::memset(m, 0, size_t(width) * height);
  for (int y = 1; y + 1 < height; ++y)
    mark_maxima(gradient.magnitude.row(y - 1), gradient.magnitude.row(y), gradient.magnitude.row(y + 1),
                gradient.dx.row(y), gradient.dy.row(y), low, high, mask.row(y), width);
  keep_linked(&mask);
  return mask;
}

void keep_linked(Plane<uint8_t>* mask) {
  const int width = mask->width();
  uint8_t* const m = mask->row(0);
  Maxima found(*mask);
  const int steps[8] = {1, width + 1, width, width - 1, -1, -width - 1, -width, 1 - width};
  std::vector<int>& open = found.strong;
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    for (const int step : steps)
      if (m[at + step] == kWeak) {
        m[at + step] = kEdge;
        open.push_back(at + step);
      }
  }
  for (const int at : found.weak)
    if (m[at] == kWeak) m[at] = 0;
}

}  // namespace edgevo
