// SPDX-License-Identifier: BSD-3-Clause
#include "shading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace edgevo {
namespace {

constexpr int kMaxTaps = 8;
constexpr int kFractionBits = 8;

// log2 of a positive number, linear between powers of two: at most 0.09 too low, and no call into a library
// whose last digit depends on the machine.
float fast_log2(float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return float(int32_t(bits) - 0x3f800000) * (1.0f / float(1 << 23));
}

// Bilinear interpolation at fixed-point texel coordinates (24.8, pixel centres at whole numbers). Returns
// 0..255 in 16.16.
template <bool kTiled>
int32_t bilinear(const TextureLevel& t, int32_t x, int32_t y) {
  if (!kTiled) {
    x = std::clamp(x, 0, (t.width - 1) << kFractionBits);
    y = std::clamp(y, 0, (t.height - 1) << kFractionBits);
  }
  const int32_t fx = x & 255, fy = y & 255;
  const int32_t mask_x = t.width - 1, mask_y = t.height - 1;
  const int32_t x0 = (x >> kFractionBits) & mask_x, y0 = (y >> kFractionBits) & mask_y;
  // At the last texel of a clamped texture the fraction is zero, so that the wrapped neighbour does not
  // count.
  const int32_t x1 = (x0 + 1) & mask_x, y1 = (y0 + 1) & mask_y;
  const uint8_t* upper = t.gray.data() + size_t(y0) * t.width;
  const uint8_t* lower = t.gray.data() + size_t(y1) * t.width;
  const int32_t a = upper[x0] * (256 - fx) + upper[x1] * fx;
  const int32_t b = lower[x0] * (256 - fx) + lower[x1] * fx;
  return a * (256 - fy) + b * fy;
}

// A pixel's footprint in texels of level 0: centre, longer axis, and the length of the shorter one.
struct Footprint {
  float u, v, major_u, major_v, minor, major;
};

Footprint footprint(const ViewSurface& view, const ShadingContext& c, float x, float y, float z) {
  const Eigen::Vector3f& N = view.idepth_f;
  Footprint f;
  f.u = (view.u.x() * x + view.u.y() * y + view.u.z()) * z;
  f.v = (view.v.x() * x + view.v.y() * y + view.v.z()) * z;
  const float nx = N.x(), ny = N.y(), sx = z * c.pixel_x, sy = z * c.pixel_y;
  const float ux = (view.u.x() - f.u * nx) * sx, vx = (view.v.x() - f.v * nx) * sx;
  const float uy = (view.u.y() - f.u * ny) * sy, vy = (view.v.y() - f.v * ny) * sy;
  const float along_x = ux * ux + vx * vx, along_y = uy * uy + vy * vy;
  const bool x_longer = along_x > along_y;
  f.major_u = x_longer ? ux : uy, f.major_v = x_longer ? vx : vy;
  f.major = std::max(1e-4f, std::sqrt(x_longer ? along_x : along_y));
  f.minor = std::max(std::abs(ux * vy - uy * vx) / f.major, f.major / kMaxTaps);
  return f;
}

template <bool kTiled>
int64_t sum_of_taps(const TextureLevel& t, int level, const Footprint& f, int taps) {
  const float scale = float(1 << kFractionBits) / float(1 << level);
  const float step_u = f.major_u * scale / float(taps), step_v = f.major_v * scale / float(taps);
  const float shift = 0.5f * float(taps - 1), half = 0.5f * float(1 << kFractionBits);
  float u = f.u * scale - half - shift * step_u, v = f.v * scale - half - shift * step_v;
  constexpr float kBias = float(1 << 22);  // makes truncation a floor; a multiple of every texture's size
  int64_t sum = 0;
  for (int i = 0; i < taps; ++i, u += step_u, v += step_v) {
    const int32_t iu = kTiled ? int32_t(u + kBias) : int32_t(u),
                  iv = kTiled ? int32_t(v + kBias) : int32_t(v);
    sum += bilinear<kTiled>(t, iu, iv);
  }
  return sum;
}

template <bool kTiled>
float sample(const Texture& texture, const Footprint& f) {
  const int taps = std::clamp(int(f.major / f.minor + 0.7f), 1, kMaxTaps);
  const float level = std::clamp(fast_log2(f.minor), 0.0f, float(texture.levels.size() - 1));
  const int fine = int(level);
  const float share = level - float(fine);
  const float norm = 1.0f / (65536.0f * float(taps));
  float gray = float(sum_of_taps<kTiled>(texture.levels[size_t(fine)], fine, f, taps)) * norm;
  if (share < 0.02f || size_t(fine) + 1 >= texture.levels.size()) return gray;
  const float coarse = float(sum_of_taps<kTiled>(texture.levels[size_t(fine) + 1], fine + 1, f, taps)) * norm;
  return gray + share * (coarse - gray);
}

// Factor of the shadows where the ray (x, y, 1) meets the ground at depth z.
float shadow_factor(const ViewSurface& view, const ShadingContext& c, float x, float y, float z) {
  const Eigen::Vector2f p = c.eye + z * (view.ground * Eigen::Vector3f(x, y, 1));
  float factor = 0;
  for (int i = 0; i < 2; ++i)
    if (c.weights[i] > 0) factor += c.weights[i] * c.shadows[i]->factor(p.x(), p.y());
  return factor;
}

}  // namespace

float shade(const ViewSurface& view, const ShadingContext& c, float x, float y) {
  const float q = view.idepth_f.x() * x + view.idepth_f.y() * y + view.idepth_f.z();
  const Footprint f = footprint(view, c, x, y, 1.0f / q);
  const Surface& s = *view.surface;
  float gray = view.gain * (s.is_tiled ? sample<true>(*view.texture, f) : sample<false>(*view.texture, f));
  if (view.takes_shadows) gray *= shadow_factor(view, c, x, y, 1.0f / q);
  return c.exposure * (gray + (c.haze_gray - gray) * (c.haze_per_metre / (q + c.haze_per_metre)));
}

float shade_sky(const ViewSurface& view, const ShadingContext& c, float x, float y) {
  const float q = view.idepth_f.x() * x + view.idepth_f.y() * y + view.idepth_f.z();
  constexpr float kHorizon = 4e-5f;  // clouds beyond 25 km drown in the haze
  if (q <= kHorizon) return c.exposure * c.haze_gray;
  const float gray = sample<true>(*view.texture, footprint(view, c, x, y, 1.0f / q));
  const float share = std::min(1.0f, (q - kHorizon) * 2500.0f);
  return c.exposure * (c.haze_gray + share * (gray - c.haze_gray));
}

}  // namespace edgevo
