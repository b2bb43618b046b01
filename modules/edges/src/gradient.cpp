// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/gradient.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

// Binomial and Sobel are separable, and so is their product: seven taps to smooth, [1 4 6 4 1] * [1 2 1], and
// seven to differentiate, [1 4 6 4 1] * [-1 0 1]. In 16 bits: a smoothed value is at most 64 * 255; an eighth
// of it times the taps 5, 4, 1 is at most 20400.
constexpr int kReach = 3;
constexpr int kTaps = 2 * kReach + 1;

template <class T>
using Window = std::array<const T*, kTaps>;  // seven rows, or one row at seven offsets

template <class T>
Window<T> along(const T* row) {
  Window<T> w;
  for (int k = 0; k < kTaps; ++k) w[k] = row + k;
  return w;
}

EDGEVO_WIDE_CLONES void smooth(const uint8_t* __restrict a, const uint8_t* __restrict b,
                               const uint8_t* __restrict c, const uint8_t* __restrict d,
                               const uint8_t* __restrict e, const uint8_t* __restrict f,
                               const uint8_t* __restrict g, int16_t* __restrict out, int n) {
  for (int i = 0; i < n; ++i) {
    const uint16_t outer = uint16_t(a[i] + g[i]), next = uint16_t(b[i] + f[i]), inner = uint16_t(c[i] + e[i]);
    out[i] = int16_t(uint16_t(outer + 6 * next + 15 * inner + 20 * d[i] + 4) >> 3);
  }
}

EDGEVO_WIDE_CLONES void differentiate(const int16_t* __restrict a, const int16_t* __restrict b,
                                      const int16_t* __restrict c, const int16_t* __restrict e,
                                      const int16_t* __restrict f, const int16_t* __restrict g,
                                      int16_t* __restrict out, int n) {
  for (int i = 0; i < n; ++i) {
    const int16_t outer = int16_t(g[i] - a[i]), next = int16_t(f[i] - b[i]), inner = int16_t(e[i] - c[i]);
    out[i] = int16_t(outer + 4 * next + 5 * inner);
  }
}

EDGEVO_WIDE_CLONES void take_magnitude(const int16_t* __restrict dx, const int16_t* __restrict dy,
                                       float* __restrict out, int n) {
  for (int i = 0; i < n; ++i) {
    const float x = dx[i], y = dy[i];
    out[i] = std::sqrt(x * x + y * y) * (1.0f / kGradientSteps);
  }
}

void smooth(const Window<uint8_t>& w, int16_t* out, int n) {
  smooth(w[0], w[1], w[2], w[3], w[4], w[5], w[6], out, n);
}
void differentiate(const Window<int16_t>& w, int16_t* out, int n) {
  differentiate(w[0], w[1], w[2], w[4], w[5], w[6], out, n);
}

// The last seven rows of an image, each extended by three pixels on both sides, and the same rows smoothed
// horizontally.
class RowRing {
 public:
  explicit RowRing(const ImageView<uint8_t>& gray) : gray_(gray), padded_(gray.width + 2 * kReach) {
    for (int k = 0; k < kTaps; ++k) pixels_[k].resize(padded_), smoothed_[k].resize(gray.width);
  }
  int padded() const { return padded_; }

  void load(int y) {
    uint8_t* to = pixels_[slot(y)].data();
    const uint8_t* from = gray_.row(std::clamp(y, 0, gray_.height - 1));
    std::memset(to, from[0], kReach);
    std::memcpy(to + kReach, from, gray_.width);
    std::memset(to + kReach + gray_.width, from[gray_.width - 1], kReach);
    smooth(along<uint8_t>(to), smoothed_[slot(y)].data(), gray_.width);
  }
  // Rows y - 3 to y + 3.
  Window<uint8_t> pixels(int y) const { return rows<uint8_t>(pixels_, y); }
  Window<int16_t> smoothed(int y) const { return rows<int16_t>(smoothed_, y); }

 private:
  static int slot(int y) { return (y + kTaps) % kTaps; }
  template <class T>
  static Window<T> rows(const std::array<std::vector<T>, kTaps>& ring, int y) {
    Window<T> w;
    for (int k = 0; k < kTaps; ++k) w[k] = ring[slot(y + k - kReach)].data();
    return w;
  }

  ImageView<uint8_t> gray_;
  int padded_;
  std::array<std::vector<uint8_t>, kTaps> pixels_;
  std::array<std::vector<int16_t>, kTaps> smoothed_;
};

}  // namespace

Gradient compute_gradient(const ImageView<uint8_t>& gray) {
  const int width = gray.width, height = gray.height;
  Gradient g{Plane<int16_t>(width, height), Plane<int16_t>(width, height), Plane<float>(width, height)};
  RowRing ring(gray);
  std::vector<int16_t> column_smoothed(ring.padded());
  for (int y = -kReach; y < kReach; ++y) ring.load(y);
  for (int y = 0; y < height; ++y) {
    ring.load(y + kReach);
    smooth(ring.pixels(y), column_smoothed.data(), ring.padded());
    differentiate(along<int16_t>(column_smoothed.data()), g.dx.row(y), width);
    differentiate(ring.smoothed(y), g.dy.row(y), width);
    take_magnitude(g.dx.row(y), g.dy.row(y), g.magnitude.row(y), width);
  }
  return g;
}

GradientHistogram::GradientHistogram(const Plane<float>& magnitude) {
  for (int y = 0; y < magnitude.height(); y += 2) {
    const float* row = magnitude.row(y);
    for (int x = 0; x < magnitude.width(); x += 2, ++total_) ++count_[std::min(int(row[x]), kBins - 1)];
  }
}

float GradientHistogram::percentile(double percentile) const {
  int below = 0;
  for (int b = 0; b < kBins; ++b)
    if ((below += count_[b]) >= percentile * total_) return float(b + 1);
  return float(kBins);
}

}  // namespace edgevo
