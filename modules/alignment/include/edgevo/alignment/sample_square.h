// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bilinear interpolation of a square of samples that share one sub-pixel offset.
#include <cstddef>

namespace edgevo {

/// Writes kSide * kSide interpolated values row by row. `corner` is the grid point of the first sample; each
/// sample lies (fx, fy) beyond its grid point. Reads one row and one column more. Each row is interpolated
/// horizontally once and used for the values above and below it.
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
    for (int u = 0; u < kSide; ++u) to[u] = above[u] + fy * (below[u] - above[u]);
  }
}

}  // namespace edgevo
