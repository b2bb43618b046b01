// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/gradient.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "edgevo/core/simd.h"
#include "edgevo/edges/deep_gray.h"

namespace edgevo {
namespace {

// Binomial and Sobel are separable, and so is their product: seven taps to smooth, [1 4 6 4 1] * [1 2 1], and
// seven to differentiate, [1 4 6 4 1] * [-1 0 1]. Pixels of 8 bits are processed in 16 bits: a smoothed value
// is at most 64 * 255; an eighth of it times the taps 5, 4, 1 is at most 20400. Those of 16 bits in 32: 64 *
// 65535 times the taps is at most 42 million, and the result is limited to 16 bits (contrasts beyond 255).
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

EDGEVO_WIDE_CLONES void smooth(const uint16_t* __restrict a, const uint16_t* __restrict b,
                               const uint16_t* __restrict c, const uint16_t* __restrict d,
                               const uint16_t* __restrict e, const uint16_t* __restrict f,
                               const uint16_t* __restrict g, int32_t* __restrict out, int n) {
  for (int i = 0; i < n; ++i) out[i] = a[i] + g[i] + 6 * (b[i] + f[i]) + 15 * (c[i] + e[i]) + 20 * d[i];
}

EDGEVO_WIDE_CLONES void differentiate(const int32_t* __restrict a, const int32_t* __restrict b,
                                      const int32_t* __restrict c, const int32_t* __restrict e,
                                      const int32_t* __restrict f, const int32_t* __restrict g,
                                      int16_t* __restrict out, int n) {
  constexpr int kSteps = 8 * kDeepSteps;  // of the sum, per step of the gradient
  for (int i = 0; i < n; ++i) {
    const int32_t sum = g[i] - a[i] + 4 * (f[i] - b[i]) + 5 * (e[i] - c[i]);
    const int32_t rounded = (sum + kSteps / 2) >> 10;
    out[i] = int16_t(std::min(std::max(rounded, -32767), 32767));
  }
  static_assert(kSteps == 1 << 10);
}

template <class T, class S>
void smooth(const Window<T>& w, S* out, int n) {
  smooth(w[0], w[1], w[2], w[3], w[4], w[5], w[6], out, n);
}
template <class S>
void differentiate(const Window<S>& w, int16_t* out, int n) {
  differentiate(w[0], w[1], w[2], w[4], w[5], w[6], out, n);
}

// The last seven rows of an image, each extended by three pixels on both sides, and the same rows smoothed
// horizontally.
template <class T, class S>
class RowRing {
 public:
  explicit RowRing(const ImageView<T>& gray) : gray_(gray), padded_(gray.width + 2 * kReach) {
    for (int k = 0; k < kTaps; ++k) pixels_[k].resize(padded_), smoothed_[k].resize(gray.width);
  }
  int padded() const { return padded_; }

  void load(int y) {
    T* to = pixels_[slot(y)].data();
    const T* from = gray_.row(std::clamp(y, 0, gray_.height - 1));
    std::fill_n(to, kReach, from[0]);
    std::copy_n(from, gray_.width, to + kReach);
    std::fill_n(to + kReach + gray_.width, kReach, from[gray_.width - 1]);
    smooth(along<T>(to), smoothed_[slot(y)].data(), gray_.width);
  }
  // Rows y - 3 to y + 3.
  Window<T> pixels(int y) const { return rows<T>(pixels_, y); }
  Window<S> smoothed(int y) const { return rows<S>(smoothed_, y); }

 private:
  static int slot(int y) { return (y + kTaps) % kTaps; }
  template <class V>
  static Window<V> rows(const std::array<std::vector<V>, kTaps>& ring, int y) {
    Window<V> w;
    for (int k = 0; k < kTaps; ++k) w[k] = ring[slot(y + k - kReach)].data();
    return w;
  }

  ImageView<T> gray_;
  int padded_;
  std::array<std::vector<T>, kTaps> pixels_;
  std::array<std::vector<S>, kTaps> smoothed_;
};

// S: type of smoothed values.
template <class S, class T>
Gradient gradient_of(const ImageView<T>& gray) {
  const int width = gray.width, height = gray.height;
  Gradient g{Plane<int16_t>(width, height), Plane<int16_t>(width, height), Plane<float>(width, height)};
  RowRing<T, S> ring(gray);
  std::vector<S> column_smoothed(ring.padded());
  for (int y = -kReach; y < kReach; ++y) ring.load(y);
  for (int y = 0; y < height; ++y) {
    ring.load(y + kReach);
    smooth(ring.pixels(y), column_smoothed.data(), ring.padded());
    differentiate(along<S>(column_smoothed.data()), g.dx.row(y), width);
    differentiate(ring.smoothed(y), g.dy.row(y), width);
    take_magnitude(g.dx.row(y), g.dy.row(y), g.magnitude.row(y), width);
  }
  return g;
}

// The bin of every second value of a row.
EDGEVO_WIDE_CLONES void take_bins(const float* __restrict row, int count, int last, int32_t* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const int bin = int(row[2 * i]);
    out[i] = bin < last ? bin : last;
  }
}

}  // namespace

Gradient compute_gradient(const ImageView<uint8_t>& gray) { return gradient_of<int16_t>(gray); }
Gradient compute_gradient(const ImageView<uint16_t>& gray) { return gradient_of<int32_t>(gray); }

GradientHistogram::GradientHistogram(const Plane<float>& magnitude) {
  const int width = magnitude.width(), height = magnitude.height();
  const int in_row = (width + 1) / 2;
  std::vector<int32_t> bins(static_cast<size_t>(in_row));
  for (int y = 0; y < height; y += 2) {
    take_bins(magnitude.row(y), in_row, kBins - 1, bins.data());
    for (const int32_t bin : bins) ++count_[bin];
  }
  total_ = in_row * ((height + 1) / 2);
}

float GradientHistogram::percentile(double percentile) const {
  int below = 0;
  for (int b = 0; b < kBins; ++b)
    if ((below += count_[b]) >= percentile * total_) return float(b + 1);
  return float(kBins);
}

}  // namespace edgevo
