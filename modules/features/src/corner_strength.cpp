// SPDX-License-Identifier: BSD-3-Clause
#include "corner_strength.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

constexpr int kBorder = 2;

// The gradient's products in one row, summed over three pixels across.
struct RowSums {
  std::vector<float> xx, xy, yy;
};

struct GradientRow {
  std::vector<float> x, y;
};

EDGEVO_WIDE_CLONES void differentiate(const uint8_t* __restrict above, const uint8_t* __restrict row,
                                      const uint8_t* __restrict below, int width, float* __restrict x,
                                      float* __restrict y) {
  for (int u = 1; u < width - 1; ++u) {
    const int left = above[u - 1] + 2 * row[u - 1] + below[u - 1],
              right = above[u + 1] + 2 * row[u + 1] + below[u + 1];
    const int up = above[u - 1] + 2 * above[u] + above[u + 1],
              down = below[u - 1] + 2 * below[u] + below[u + 1];
    x[u] = float(right - left), y[u] = float(down - up);
  }
}

EDGEVO_WIDE_CLONES void sum_across(const float* __restrict x, const float* __restrict y, int width,
                                   float* __restrict xx, float* __restrict xy, float* __restrict yy) {
  for (int u = kBorder; u < width - kBorder; ++u) {
    xx[u] = x[u - 1] * x[u - 1] + x[u] * x[u] + x[u + 1] * x[u + 1];
    xy[u] = x[u - 1] * y[u - 1] + x[u] * y[u] + x[u + 1] * y[u + 1];
    yy[u] = y[u - 1] * y[u - 1] + y[u] * y[u] + y[u + 1] * y[u + 1];
  }
}

EDGEVO_WIDE_CLONES void take_eigenvalues(const RowSums& a, const RowSums& b, const RowSums& c, int width,
                                         float* __restrict strength) {
  const float *axx = a.xx.data(), *bxx = b.xx.data(), *cxx = c.xx.data();
  const float *axy = a.xy.data(), *bxy = b.xy.data(), *cxy = c.xy.data();
  const float *ayy = a.yy.data(), *byy = b.yy.data(), *cyy = c.yy.data();
  for (int u = kBorder; u < width - kBorder; ++u) {
    const float xx = axx[u] + bxx[u] + cxx[u], xy = axy[u] + bxy[u] + cxy[u], yy = ayy[u] + byy[u] + cyy[u];
    const float half = 0.5f * (xx + yy), off = 0.5f * (xx - yy);
    strength[u] = half - std::sqrt(off * off + xy * xy);
  }
}

}  // namespace

Plane<float> corner_strength(const ImageView<uint8_t>& image) {
  const int width = image.width, height = image.height;
  Plane<float> strength(width, height);
  std::fill_n(strength.row(0), size_t(width) * height, 0.f);
  const std::vector<float> zeros(size_t(width), 0.f);
  GradientRow g{zeros, zeros};
  RowSums sums[3];
  for (RowSums& s : sums) s = {zeros, zeros, zeros};
  for (int y = 1; y < height - 1; ++y) {
    const uint8_t* row = image.data + std::ptrdiff_t(y) * image.stride;
    differentiate(row - image.stride, row, row + image.stride, width, g.x.data(), g.y.data());
    RowSums& now = sums[y % 3];
    sum_across(g.x.data(), g.y.data(), width, now.xx.data(), now.xy.data(), now.yy.data());
    if (y > kBorder) take_eigenvalues(sums[0], sums[1], sums[2], width, strength.row(y - 1));
  }
  return strength;
}

}  // namespace edgevo
