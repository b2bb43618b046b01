// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bilinear interpolation of a square of samples that share one sub-pixel offset.
#include <cstddef>

#include "edgevo/edges/deep_gray.h"

namespace edgevo {

/// Writes kSide * kSide interpolated values row by row. `corner` is the grid point of the first sample; each
/// sample lies (fx, fy) beyond its grid point. Reads one row and one column more. Each row is interpolated
/// horizontally once and used for the values above and below it. Pixels of 16 bits become gray levels.
template <int kSide, class T>
inline void sample_square(const T* corner, std::ptrdiff_t stride, float fx, float fy, float* to) {
  float rows[2][kSide];
  const auto interpolate = [fx](const T* row, float* out) {
    for (int u = 0; u < kSide; ++u) out[u] = float(row[u]) + fx * (float(row[u + 1]) - float(row[u]));
  };
  interpolate(corner, rows[0]);
  for (int v = 0; v < kSide; ++v, to += kSide) {
    const float* above = rows[v & 1];
    float* below = rows[(v + 1) & 1];
    corner += stride;
    interpolate(corner, below);
    for (int u = 0; u < kSide; ++u) to[u] = kGrayPerStep<T> * (above[u] + fy * (below[u] - above[u]));
  }
}

/// Floats that sample_square_wide() writes for a side: more than kSide * kSide for short ones.
constexpr int wide_square_floats(int side) { return side < 8 ? (side - 1) * side + 8 : side * side; }
/// Columns that it reads of each row.
constexpr int wide_square_columns(int side) { return side < 8 ? 9 : side + 1; }
/// The same values as sample_square(), eight at a time: in less than half of its time. For sides of 5, 7, 9
/// and 11, and T = uint8_t, uint16_t or float; the two functions above say what it reads and writes.
template <int kSide, class T>
void sample_square_wide(const T* corner, std::ptrdiff_t stride, float fx, float fy, float* to);

}  // namespace edgevo
