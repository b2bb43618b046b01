// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/image_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "edgevo/core/order_statistics.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// ---- exposure ----

constexpr int kRowStep = 16;  // enough rows for a share
constexpr int kSlack = 2;     // gray levels: compression moves saturated pixels that far

// 1 for a pixel at either end of the range.
int is_saturated(uint8_t gray) { return uint8_t(gray + kSlack + 1) <= 2 * kSlack + 1; }

// Such pixels in row y; those of more than 8 bits are saturated at the ends of the camera's values:
// compression is lossless, and black and white of their scale need not be the camera's.
class Saturation {
 public:
  explicit Saturation(const GrayImage& image) : image_(image) {
    const double white = image.scale.black == 0 ? 256 * image.scale.per_level - 1 : kMaxValue;
    white_ = int(std::lround(std::min(white, kMaxValue)));
  }
  int at(int x, int y) const {
    const size_t i = size_t(y) * image_.width + x;
    if (!image_.is_deep()) return is_saturated(image_.pixels[i]);
    const int value = image_.values[i];
    return value == 0 || value == white_ || value == int(kMaxValue);
  }

 private:
  static constexpr double kMaxValue = 65535;
  const GrayImage& image_;
  int white_ = 0;
};

// ---- blur ----

constexpr size_t kMinSharpEdges = 100;
constexpr size_t kSamples = 300;  // edge pixels: enough for a median

// Bilinear; the position is moved into the image.
float interpolate(const Plane<float>& plane, float x, float y) {
  const float u = std::clamp(x, 0.0f, float(plane.width() - 2)),
              v = std::clamp(y, 0.0f, float(plane.height() - 2));
  const int i = int(u), j = int(v);
  const float *upper = plane.row(j) + i, *lower = plane.row(j + 1) + i;
  const float a = u - float(i), b = v - float(j);
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

}  // namespace

double saturated_share(const FramePyramid& pyramid) {
  const GrayImage& image = pyramid.source;
  const Saturation saturation(image);
  int saturated = 0, counted = 0;
  for (int y = kRowStep / 2; y < image.height; y += kRowStep) {
    const uint8_t* masked = pyramid.border_mask ? pyramid.border_mask->row(y) : nullptr;
    for (int x = 0; x < image.width; ++x) {
      const int counts = !masked || !masked[x];
      counted += counts;
      saturated += counts & saturation.at(x, y);
    }
  }
  return counted > 0 ? double(saturated) / counted : kUnknown;
}

// With s^2 the variance of the blur, the gradient across a step is proportional to 1 / sqrt(s^2 + v). v is
// the variance of the smoothing: 1.4 px^2 on the finest level (binomial 5x5 and Sobel), 6.6 px^2 on the
// second (the same on pixels of twice the size, and the binomial that halves the image).
double edge_blur(const FramePyramid& pyramid) {
  const std::vector<EdgePixel>& edges = pyramid.finest().edges.pixels;
  if (edges.size() < kMinSharpEdges || pyramid.levels.size() < 2) return kUnknown;
  const Plane<float>& second = pyramid.levels[1].gradient_magnitude;
  if (second.width() < 2 || second.height() < 2) return kUnknown;
  std::vector<float> ratios;
  ratios.reserve(kSamples);
  for (size_t i = 0; i < kSamples; ++i) {
    const EdgePixel& e = edges[i * edges.size() / kSamples];
    // A pixel of the second level is two of the finest one wide.
    const float there = interpolate(second, 0.5f * e.x, 0.5f * e.y) / (2 * kSobelPerGrayLevel);
    ratios.push_back(there / e.strength);
  }
  return double(median(std::move(ratios)));
}

}  // namespace edgevo
