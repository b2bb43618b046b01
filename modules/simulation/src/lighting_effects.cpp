// SPDX-License-Identifier: BSD-3-Clause
#include "lighting_effects.h"

#include <algorithm>
#include <cmath>

#include "smooth_noise.h"

namespace edgevo {
namespace {

void scale(double gain, double bias, LitImage* image) {
  for (float& g : image->gray) g = float(gain) * g + float(bias);
}

// Calls f(x, y, gray) for every pixel, x and y in -1..1 across the longer side.
template <class F>
void for_pixels(LitImage* image, F f) {
  const float half = 0.5f * float(std::max(image->width, image->height));
  for (int v = 0; v < image->height; ++v)
    for (int u = 0; u < image->width; ++u)
      f((float(u) - 0.5f * float(image->width - 1)) / half,
        (float(v) - 0.5f * float(image->height - 1)) / half, image->gray[size_t(v) * image->width + u]);
}

// Mean over 2 radius + 1 pixels along a row or column; `step` and `count` walk the line, continued beyond its
// ends.
void box_line(const float* in, float* out, int count, int step, int radius) {
  const auto at = [&](int i) { return in[std::clamp(i, 0, count - 1) * step]; };
  float sum = 0;
  for (int i = -radius; i <= radius; ++i) sum += at(i);
  for (int i = 0; i < count; ++i) {
    out[i * step] = sum / float(2 * radius + 1);
    sum += at(i + radius + 1) - at(i - radius);
  }
}

void box_blur(std::vector<float>* gray, int width, int height, int radius) {
  std::vector<float> rows(gray->size());
  for (int v = 0; v < height; ++v)
    box_line(gray->data() + size_t(v) * width, rows.data() + size_t(v) * width, width, 1, radius);
  for (int u = 0; u < width; ++u) box_line(rows.data() + u, gray->data() + u, height, width, radius);
}

float smooth_step(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace

void drift_gain(Random random, double seconds, double share, LitImage* image) {
  const SmoothNoise gain(&random, 0.12), bias(&random, 0.1);
  const auto limited = [](double x) { return std::clamp(x / 2, -1.0, 1.0); };
  scale(std::exp(0.5 * share * limited(gain(seconds))), 25 * share * limited(bias(seconds)), image);
}

void jump_exposure(Random random, double seconds, double share, LitImage* image) {
  double begin = random.uniform(0.5, 2), last = -1, log_gain = 0;
  for (; begin <= seconds; begin += random.uniform(1, 4)) {
    last = begin;
    log_gain = (random.uniform() < 0.5 ? -1 : 1) * std::log(2.2) * random.uniform(0.5, 1);
  }
  if (last < 0) return;
  scale(std::exp(share * log_gain * std::exp(-(seconds - last) / 0.6)), 0, image);
}

void bend_response(Random random, double seconds, double share, LitImage* image) {
  const SmoothNoise bend(&random, 0.1);
  const float exponent = float(std::exp(share * 0.48 * std::clamp(bend(seconds) / 1.5, -1.0, 1.0)));
  float table[256];
  for (int i = 0; i < 256; ++i) table[i] = 255 * std::pow(float(i) / 255, exponent);
  for (float& g : image->gray) {
    const float x = std::clamp(g, 0.0f, 254.99f);
    const int i = int(x);
    g = table[i] + (x - float(i)) * (table[i + 1] - table[i]);
  }
}

void vignette(double share, LitImage* image) {
  const float corner2 = 1 + std::pow(float(std::min(image->width, image->height)) /
                                         float(std::max(image->width, image->height)),
                                     2.0f);
  for_pixels(image,
             [&](float x, float y, float& g) { g *= 1 - float(0.65 * share) * (x * x + y * y) / corner2; });
}

void add_glare(Random random, double seconds, double share, LitImage* image) {
  const SmoothNoise across(&random, 0.08), down(&random, 0.08), strength(&random, 0.2);
  const float cx = float(0.7 * across(seconds)), cy = float(0.2 * down(seconds) - 0.1);
  const float core = float(share * 420 * std::clamp(0.6 + 0.5 * strength(seconds), 0.0, 1.0)),
              veil = core * 0.16f;
  for_pixels(image, [&](float x, float y, float& g) {
    const float d2 = (x - cx) * (x - cx) + (y - cy) * (y - cy);
    g += core / (1 + 900 * d2 * d2 * 10) + veil / (1 + 8 * d2);
  });
}

void bloom_highlights(LitImage* image) {
  constexpr float kFull = 205;  // saturation, from which a pixel spills over
  std::vector<float> spill(image->gray.size());
  for (size_t i = 0; i < spill.size(); ++i) spill[i] = image->gray[i] > kFull ? 255.0f : 0.0f;
  box_blur(&spill, image->width, image->height, 4);
  box_blur(&spill, image->width, image->height, 2);
  for (size_t i = 0; i < spill.size(); ++i) image->gray[i] += 1.4f * std::max(0.0f, spill[i] - 25);
}

void sweep_shadows(Random random, double seconds, LitImage* image) {
  for (int band = 0; band < 3; ++band) {
    const double angle = random.uniform(-0.9, 0.9),
                 speed = random.uniform(0.25, 0.7) * (random.uniform() < 0.5 ? -1 : 1);
    const double phase = random.uniform(0, 4), half = random.uniform(0.08, 0.3),
                 rim = random.uniform(0.01, 0.06);
    const float c = float(std::cos(angle)), s = float(std::sin(angle));
    // Returns every four widths.
    const float middle = float(std::fmod(std::fmod(phase + speed * seconds, 4) + 4, 4) - 2);
    for_pixels(image, [&](float x, float y, float& g) {
      const float inside = float(half) - std::abs(c * x + s * y - middle);
      if (inside > -float(rim)) g *= 1 - 0.6f * smooth_step(0.5f + 0.5f * inside / float(rim));
    });
  }
}

void blur_along_motion(Random random, double seconds, LitImage* image) {
  const SmoothNoise along_u(&random, 0.5), along_v(&random, 0.5);
  const double du = 4 * std::clamp(along_u(seconds), -1.1, 1.1),
               dv = 2 * std::clamp(along_v(seconds), -1.1, 1.1);
  constexpr int kTaps = 9;
  std::vector<float> out(image->gray.size(), 0.0f);
  for (int tap = 0; tap < kTaps; ++tap) {
    const double t = double(tap - kTaps / 2) / (kTaps / 2);
    const int su = int(std::lround(t * du)), sv = int(std::lround(t * dv));
    for (int v = 0; v < image->height; ++v) {
      const float* row = image->gray.data() + size_t(std::clamp(v + sv, 0, image->height - 1)) * image->width;
      for (int u = 0; u < image->width; ++u)
        out[size_t(v) * image->width + u] += row[std::clamp(u + su, 0, image->width - 1)] * (1.0f / kTaps);
    }
  }
  image->gray = std::move(out);
}

}  // namespace edgevo
