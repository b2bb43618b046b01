// SPDX-License-Identifier: BSD-3-Clause
#include "deep_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "edgevo/core/simd.h"
#include "edgevo/edges/deep_gray.h"

namespace edgevo {
namespace {

constexpr int kRowStep = 8, kColumnStep = 2;  // enough pixels for quantiles
// Range of an image, without its darkest and brightest pixels: defects, lamps.
constexpr double kDull = 0.01;      // on both sides, for the contrast of the scene
constexpr double kOutliers = 1e-3;  // on both sides, for what 16 bits should hold
// A quarter of the gray levels: an image that uses fewer is spread.
constexpr double kMinSpread = 64;
// Limit of the gain times noise, gray levels: the gradient of white noise of one gray level is 0.136 gray
// levels per pixel, and six times it stays below the floor of the edge thresholds (min_gradient, 3).
constexpr double kMaxNoise = 3.0 / (6 * 0.136);
constexpr double kRoundingNoise = 0.29;  // of whole numbers: 1 / sqrt(12)
// The second difference of white noise is sqrt(6) times as large; its median magnitude is 0.6745 sigma.
constexpr double kSigmaPerSecondDifference = 1 / (0.6745 * 2.449);
// Gray levels that 16 bits hold, with room for the darkest and brightest pixels.
constexpr double kDarkest = kDeepBlack + 32, kBrightest = kDeepWhite - 32;

template <class T>
T quantile(std::vector<T>* values, double share) {
  const auto nth = values->begin() + std::ptrdiff_t(share * double(values->size() - 1));
  std::nth_element(values->begin(), nth, values->end());
  return *nth;
}

// Some pixels of an image, with the second differences of their rows.
struct Samples {
  std::vector<uint16_t> values;
  std::vector<int> second_differences;

  explicit Samples(const GrayImage& image) {
    for (int y = 0; y < image.height; y += kRowStep) {
      const uint16_t* row = image.values.data() + size_t(y) * image.width;
      for (int x = 1; x + 1 < image.width; x += kColumnStep) {
        values.push_back(row[x]);
        second_differences.push_back(std::abs(row[x - 1] - 2 * row[x] + row[x + 1]));
      }
    }
  }
};

// Standard deviation of the noise, in units of the values; texture makes it too large.
double noise_of(Samples* samples) {
  return std::max(kRoundingNoise, kSigmaPerSecondDifference * quantile(&samples->second_differences, 0.5));
}

EDGEVO_WIDE_CLONES void convert(const uint16_t* __restrict from, float scale, float offset, int count,
                                uint16_t* __restrict to) {
  for (int i = 0; i < count; ++i) {
    const float steps = scale * float(from[i]) + offset;
    to[i] = uint16_t(int(std::min(std::max(0.0f, steps), 65535.0f) + 0.5f));
  }
}

EDGEVO_WIDE_CLONES void show(const uint16_t* __restrict from, int count, uint8_t* __restrict to) {
  for (int i = 0; i < count; ++i) {
    const int gray = (int(from[i]) + kDeepSteps / 2) / kDeepSteps + kDeepBlack;
    to[i] = uint8_t(std::min(std::max(gray, 0), 255));
  }
}

}  // namespace

Exposure exposure_of(const GrayImage& image) {
  Samples samples(image);
  if (samples.values.empty()) return {};
  const auto gray_at = [&](double share) {
    return (quantile(&samples.values, share) - image.scale.black) / image.scale.per_level;
  };
  const double spread = gray_at(1 - kDull) - gray_at(kDull);
  const double low = gray_at(kOutliers), high = gray_at(1 - kOutliers);
  Exposure e;
  if (spread > 0 && spread < kMinSpread)
    e.gain = std::clamp(kMinSpread / spread, 1.0,
                        std::max(1.0, kMaxNoise * image.scale.per_level / noise_of(&samples)));
  if (e.gain * (high - low) > kBrightest - kDarkest) e.gain = 255 / (high - low);
  if (e.gain == 1 && low >= kDarkest && high <= kBrightest) return e;
  const double half = std::min(127.5, 0.5 * e.gain * (high - low)), middle = 0.5 * (low + high);
  e.shift = std::clamp(middle, half, 255 - half) - e.gain * middle;
  return e;
}

Plane<uint16_t> deep_gray(const GrayImage& image, const Exposure& exposure) {
  const double scale = kDeepSteps * exposure.gain / image.scale.per_level;
  const double offset = kDeepSteps * (exposure.shift - kDeepBlack) - scale * image.scale.black;
  Plane<uint16_t> gray(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    convert(image.values.data() + size_t(y) * image.width, float(scale), float(offset), image.width,
            gray.row(y));
  return gray;
}

Plane<uint8_t> shown(const Plane<uint16_t>& gray) {
  Plane<uint8_t> pixels(gray.width(), gray.height());
  for (int y = 0; y < gray.height(); ++y) show(gray.row(y), gray.width(), pixels.row(y));
  return pixels;
}

}  // namespace edgevo
