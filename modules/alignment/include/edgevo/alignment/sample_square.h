#pragma once
// Bilinear values of a square of pixels that all lie the same fraction off the grid.
#include <cstddef>

namespace edgevo {

/// `corner`: the grid point of the first pixel; all pixels lie (fx, fy) beyond theirs. Writes kSide * kSide
/// values row by row; reads one row and one column more. Each row is interpolated along itself once and
/// serves the values above and below it.
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
