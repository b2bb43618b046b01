// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/canny.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "edgevo/core/simd.h"

// How vectors are passed depends on the target; these functions are only called within this file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edgevo {
namespace {

constexpr uint8_t kWeak = kWeakMark, kEdge = kStrongMark;  // in the mask: over `low`, over `high`

// Eight pixels; the compiler's vector types, which map to registers of the available width. A comparison
// gives -1 (all bits) where it holds, else 0.
constexpr int kAtOnce = 8;
using Floats8 = float __attribute__((vector_size(4 * kAtOnce)));
using Ints8 = int32_t __attribute__((vector_size(4 * kAtOnce)));
using Shorts8 = int16_t __attribute__((vector_size(2 * kAtOnce)));
using Bytes8 = uint8_t __attribute__((vector_size(kAtOnce)));

template <class Vector, class T>
inline Vector load(const T* from) {
  Vector v;
  std::memcpy(&v, from, sizeof(v));
  return v;
}
inline Floats8 load_as_floats(const int16_t* from) {
  return __builtin_convertvector(__builtin_convertvector(load<Shorts8>(from), Ints8), Floats8);
}
inline Floats8 magnitude_of(Floats8 v) { return Floats8(Ints8(v) & 0x7FFFFFFF); }

inline bool is_any(Ints8 v) {
  uint64_t words[sizeof(v) / sizeof(uint64_t)];
  std::memcpy(words, &v, sizeof(v));
  return (words[0] | words[1] | words[2] | words[3]) != 0;
}

// The row of a pixel, its gradient, and the rows above and below.
struct MaximaRows {
  const float *above, *here, *below;
  const int16_t *dx, *dy;
  float low, high;
};

// Marks of the pixels x to x + 7: kEdge above `high`, kWeak above `low`, 0 where there is no maximum across
// the edge. The direction of the gradient, rounded to 45 degrees, selects the two neighbours to compare with.
inline Bytes8 marks_at(const MaximaRows& r, int x) {
  // tan 22.5 degrees, the boundary between two of the 45 degree directions.
  constexpr float kTan22 = 0.41421356f;
  const Floats8 at = load<Floats8>(r.here + x);
  const Ints8 is_over_low = at > r.low;
  if (!is_any(is_over_low)) return Bytes8{};  // a third of an image
  const auto is_over = [&](const float* before, const float* after) {
    return (at > load<Floats8>(before + x)) & (at >= load<Floats8>(after + x));
  };
  const Floats8 gx = load_as_floats(r.dx + x), gy = load_as_floats(r.dy + x);
  const Floats8 ax = magnitude_of(gx), ay = magnitude_of(gy);
  const Ints8 along_row = ay < kTan22 * ax, along_column = ax<kTan22 * ay, falls = gx * gy> 0;
  const Ints8 diagonal = falls ? is_over(r.above - 1, r.below + 1) : is_over(r.above + 1, r.below - 1);
  const Ints8 straight = along_row ? is_over(r.here - 1, r.here + 1) : is_over(r.above, r.below);
  const Ints8 is_maximum = (along_row | along_column) ? straight : diagonal;
  const Ints8 mark = (at > r.high) ? Ints8{} + kEdge : Ints8{} + kWeak;
  // By way of 16 bits: in one step, GCC would convert pixel by pixel.
  return __builtin_convertvector(__builtin_convertvector(is_maximum & is_over_low & mark, Shorts8), Bytes8);
}

// One row of marks, without its first and last pixel. The last eight pixels overlap those before.
EDGEVO_WIDE_CLONES void mark_maxima(const MaximaRows& rows, int width, uint8_t* __restrict mask) {
  const int last = width - 1 - kAtOnce;
  for (int x = 1; x < last + kAtOnce; x += kAtOnce) {
    const int from = x < last ? x : last;
    const Bytes8 marks = marks_at(rows, from);
    std::memcpy(mask + from, &marks, sizeof(marks));
  }
}

// The same for rows that are too narrow for eight pixels: by way of wider ones.
void mark_narrow(const MaximaRows& rows, int width, uint8_t* mask) {
  constexpr int kWide = kAtOnce + 2;
  std::array<float, kWide> above{}, here{}, below{};
  std::array<int16_t, kWide> dx{}, dy{};
  std::array<uint8_t, kWide> marks{};
  std::copy_n(rows.above, width, above.begin());
  std::copy_n(rows.here, width, here.begin());
  std::copy_n(rows.below, width, below.begin());
  std::copy_n(rows.dx, width, dx.begin());
  std::copy_n(rows.dy, width, dy.begin());
  mark_maxima({above.data(), here.data(), below.data(), dx.data(), dy.data(), rows.low, rows.high}, kWide,
              marks.data());
  for (int x = 1; x < width - 1; ++x) mask[x] = marks[size_t(x)];
}

// In bytes of 0, kWeak and kEdge: the lowest bit of those that are kWeak.
constexpr uint64_t kLowestBits = 0x0101010101010101;
inline uint64_t weak_among(uint64_t bytes) { return bytes & ~(bytes >> 1) & kLowestBits; }
static_assert(kWeak == 1 && kEdge == 255, "their second bit differs");

// Thirty-two marks; a comparison gives -1 where it holds, else 0.
constexpr int kMarks = 32;
using Marks = uint8_t __attribute__((vector_size(kMarks)));
using MarkMask = int8_t __attribute__((vector_size(kMarks)));
using MarkWords = uint64_t __attribute__((vector_size(kMarks)));

// Which of the marks from `m` on are strong and touch a weak one.
inline MarkMask beginnings(const uint8_t* m, int width) {
  const MarkMask strong = load<Marks>(m) == kEdge;
  MarkMask is_weak = (load<Marks>(m - 1) == kWeak) | (load<Marks>(m + 1) == kWeak);
  for (const uint8_t* row : {m - width, m + width})
    is_weak |=
        (load<Marks>(row - 1) == kWeak) | (load<Marks>(row) == kWeak) | (load<Marks>(row + 1) == kWeak);
  return strong & is_weak;
}

// Appends the positions of the strong marks with a weak neighbour: what is linked begins there. Few of the
// strong ones have any. The border has no marks, so that whole rows may be looked at one after another;
// returns where the marks end that could be looked at.
EDGEVO_WIDE_CLONES int list_beginnings(const uint8_t* mask, int width, int size, std::vector<int>* found) {
  int at = width + 1;  // the neighbours of the one before begin outside
  for (; at + kMarks + width + 1 <= size; at += kMarks) {
    const MarkWords words = MarkWords(beginnings(mask + at, width));
    if ((words[0] | words[1] | words[2] | words[3]) == 0) continue;
    for (int w = 0; w < kMarks / 8; ++w)
      for (uint64_t bits = words[w] & kLowestBits; bits != 0; bits &= bits - 1)
        found->push_back(at + 8 * w + __builtin_ctzll(bits) / 8);
  }
  return at;
}

// The three pixels above a pixel, and in the upper half the three below it, as the lower bytes of each half.
// Of the mask nothing beyond them is read past its end.
inline uint64_t above_and_below(const uint8_t* m, int width) {
  uint32_t above, below;
  std::memcpy(&above, m - width - 1, 4);
  std::memcpy(&below, m + width - 2, 4);
  return (above & 0xFFFFFF) | uint64_t(below >> 8) << 32;
}

EDGEVO_WIDE_CLONES void clear_weak(uint8_t* m, int size) {
  for (int i = 0; i < size; ++i) m[i] = m[i] == kEdge ? kEdge : 0;
}

void clear_border(Plane<uint8_t>* mask) {
  const int width = mask->width(), height = mask->height();
  for (const int y : {0, height - 1}) std::memset(mask->row(y), 0, size_t(width));
  for (int y = 0; y < height; ++y) mask->row(y)[0] = mask->row(y)[width - 1] = 0;
}

}  // namespace

Plane<uint8_t> canny(const Gradient& gradient, float low, float high) {
  const int width = gradient.magnitude.width(), height = gradient.magnitude.height();
  Plane<uint8_t> mask(width, height);
  clear_border(&mask);
  for (int y = 1; y + 1 < height; ++y) {
    const MaximaRows rows{gradient.magnitude.row(y - 1),
                          gradient.magnitude.row(y),
                          gradient.magnitude.row(y + 1),
                          gradient.dx.row(y),
                          gradient.dy.row(y),
                          low,
                          high};
    (width < kAtOnce + 2 ? mark_narrow : mark_maxima)(rows, width, mask.row(y));
  }
  keep_linked(&mask);
  return mask;
}

void keep_linked(Plane<uint8_t>* mask) {
  const int width = mask->width();
  uint8_t* const m = mask->row(0);
  const int size = width * mask->height();
  std::vector<int> open;
  open.reserve(size_t(size) / 32);
  // At the end of the mask all strong ones.
  for (int at = list_beginnings(m, width, size, &open); at < size; ++at)
    if (m[at] == kEdge) open.push_back(at);
  const auto promote = [&](int at) {
    m[at] = kEdge;
    open.push_back(at);
  };
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    if (m[at - 1] == kWeak) promote(at - 1);
    if (m[at + 1] == kWeak) promote(at + 1);
    for (uint64_t weak = weak_among(above_and_below(m + at, width)); weak != 0; weak &= weak - 1) {
      const int byte = __builtin_ctzll(weak) / 8;
      promote(at + (byte < 4 ? byte - width : byte - 4 + width) - 1);
    }
  }
  clear_weak(m, size);
}

}  // namespace edgevo
