// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/sample_square.h"

#include <cstdint>
#include <cstring>

#include "edgevo/core/simd.h"

// How vectors are passed depends on the target; these functions are only called within this file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edgevo {
namespace {

constexpr int kAtOnce = 8;
using Floats8 = float __attribute__((vector_size(4 * kAtOnce)));
using Ints8 = int32_t __attribute__((vector_size(4 * kAtOnce)));

inline Floats8 eight(const float* from) {
  Floats8 values;
  std::memcpy(&values, from, sizeof(values));
  return values;
}
inline Floats8 eight(const uint16_t* from) {
  uint16_t values __attribute__((vector_size(2 * kAtOnce)));
  std::memcpy(&values, from, sizeof(values));
  return __builtin_convertvector(__builtin_convertvector(values, Ints8), Floats8);
}
// Step by step: in one, GCC would convert pixel by pixel.
inline Floats8 eight(const uint8_t* from) {
  using Shorts8 = int16_t __attribute__((vector_size(2 * kAtOnce)));
  uint8_t values __attribute__((vector_size(kAtOnce)));
  std::memcpy(&values, from, sizeof(values));
  const Shorts8 wider = __builtin_convertvector(values, Shorts8);
  return __builtin_convertvector(__builtin_convertvector(wider, Ints8), Floats8);
}

template <class T>
inline Floats8 between(const T* row, float fx) {
  const Floats8 left = eight(row);
  return left + fx * (eight(row + 1) - left);
}

}  // namespace

// A row is one register, or two that overlap. What one register writes beyond a short row, the next row
// overwrites.
template <int kSide, class T>
EDGEVO_WIDE_CLONES void sample_square_wide(const T* corner, std::ptrdiff_t stride, float fx, float fy,
                                           float* to) {
  constexpr int kParts = kSide > kAtOnce ? 2 : 1;
  static_assert(kSide <= 2 * kAtOnce);
  constexpr int kBegin[2] = {0, kSide - kAtOnce};
  Floats8 above[kParts];
  for (int part = 0; part < kParts; ++part) above[part] = between(corner + kBegin[part], fx);
  for (int v = 0; v < kSide; ++v, to += kSide) {
    corner += stride;
    for (int part = 0; part < kParts; ++part) {
      const Floats8 below = between(corner + kBegin[part], fx);
      const Floats8 value = kGrayPerStep<T> * (above[part] + fy * (below - above[part]));
      std::memcpy(to + kBegin[part], &value, sizeof(value));
      above[part] = below;
    }
  }
}

template void sample_square_wide<5>(const uint8_t*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<7>(const uint8_t*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<9>(const uint8_t*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<11>(const uint8_t*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<5>(const uint16_t*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<7>(const uint16_t*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<9>(const uint16_t*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<11>(const uint16_t*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<5>(const float*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<7>(const float*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<9>(const float*, std::ptrdiff_t, float, float, float*);
template void sample_square_wide<11>(const float*, std::ptrdiff_t, float, float, float*);

}  // namespace edgevo
