// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small synthetic images with known edges.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "edgevo/core/image.h"
#include "edgevo/core/random.h"

namespace edgevo::test {

/// Image whose pixels are f(x, y), clamped to 0..255.
template <class F>
GrayImage make_image(int width, int height, const F& f) {
  GrayImage image{width, height, std::vector<uint8_t>(size_t(width) * height)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.pixels[size_t(y) * width + x] =
          uint8_t(std::clamp(std::lround(f(double(x), double(y))), 0l, 255l));
  return image;
}

/// An image of a camera of `per_level` values per gray level that sees gray levels f(x, y).
template <class F>
GrayImage make_deep_image(int width, int height, const IntensityScale& scale, const F& f) {
  GrayImage image = make_image(width, height, f);
  image.scale = scale;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.values.push_back(uint16_t(
          std::clamp(std::lround(scale.black + scale.per_level * f(double(x), double(y))), 0l, 65535l)));
  return image;
}

/// A soft step (width about 2 px) through `on`, bright on the side of `normal`.
inline GrayImage slanted_step(int width, int height, const Eigen::Vector2d& on, const Eigen::Vector2d& normal,
                              double dark, double bright) {
  return make_image(width, height, [&](double x, double y) {
    const double d = normal.dot(Eigen::Vector2d(x, y) - on);
    return dark + (bright - dark) * 0.5 * (1 + std::erf(d / 1.4));
  });
}

/// A soft bright disc.
inline GrayImage disc_image(int width, int height, const Eigen::Vector2d& centre, double radius, double dark,
                            double bright) {
  return make_image(width, height, [&](double x, double y) {
    const double d = radius - (Eigen::Vector2d(x, y) - centre).norm();
    return dark + (bright - dark) * 0.5 * (1 + std::erf(d / 1.4));
  });
}

/// Smooth random texture: a sum of waves, defined on the whole plane so that it can be sampled anywhere.
class Texture {
 public:
  explicit Texture(uint64_t seed, double shortest_px = 9, double longest_px = 60) {
    Random random(seed);
    for (Wave& w : waves_) {
      const double length = random.uniform(shortest_px, longest_px), angle = random.uniform(0, 2 * M_PI);
      w = {2 * M_PI / length * Eigen::Vector2d(std::cos(angle), std::sin(angle)),
           random.uniform(0, 2 * M_PI)};
    }
  }
  double at(const Eigen::Vector2d& p) const {
    double sum = 0;
    for (const Wave& w : waves_) sum += std::sin(w.k.dot(p) + w.phase);
    return 128 + 95 * std::tanh(sum);  // saturating: gives edges, not only shading
  }

 private:
  struct Wave {
    Eigen::Vector2d k;
    double phase;
  };
  Wave waves_[12];
};

inline GrayImage textured_image(int width, int height, uint64_t seed) {
  const Texture texture(seed);
  return make_image(width, height, [&](double x, double y) { return texture.at({x, y}); });
}

}  // namespace edgevo::test
