// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/edge_extraction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edge_quota.h"
#include "edgevo/core/simd.h"
#include "edgevo/edges/edge_links.h"

namespace edgevo {
namespace {

// Number of pixels gathered, then located, at a time, so that they stay in the L1 cache.
constexpr int kRun = 256;
constexpr float kMinCurvature = 1e-3f;  // Sobel units; a flatter parabola has no usable maximum
constexpr float kMinMagnitude = 1e-3f;  // Sobel units; keeps the division finite
// Sobel units, an eighth of a gray level per pixel: below it there is no usable normal.
constexpr float kFlat = 1.0f;
using Floats = std::array<float, kRun>;

// Gradient at each pixel, and its magnitude there and at the neighbours ahead and behind along the gradient,
// in x, in y and in both.
struct Surroundings {
  Floats dx, dy, here, ahead_x, ahead_y, ahead_xy, behind_x, behind_y, behind_xy;
};

// Normals, and sub-pixel shifts along them.
struct SubPixel {
  Floats nx, ny, shift;
};

// Maximum of a parabola through the magnitudes at the pixel and one pixel along the normal on both sides, at
// most half a pixel away.
EDGEVO_WIDE_CLONES void place(const Surroundings& s, int count, SubPixel* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const float m = s.here[i], scale = 1.0f / (kGradientSteps * std::max(m, kMinMagnitude));
    const float nx = s.dx[i] * scale, ny = s.dy[i] * scale, ax = std::abs(nx), ay = std::abs(ny);
    const float ahead_row = m + ax * (s.ahead_x[i] - m),
                ahead_next = s.ahead_y[i] + ax * (s.ahead_xy[i] - s.ahead_y[i]);
    const float behind_row = m + ax * (s.behind_x[i] - m),
                behind_next = s.behind_y[i] + ax * (s.behind_xy[i] - s.behind_y[i]);
    const float ahead = ahead_row + ay * (ahead_next - ahead_row),
                behind = behind_row + ay * (behind_next - behind_row);
    const float curvature = behind - 2.0f * m + ahead;
    // A division that is always defined needs no branch.
    const float top = 0.5f * (behind - ahead) / std::min(curvature, -kMinCurvature);
    out->nx[i] = nx, out->ny[i] = ny;
    out->shift[i] = curvature < -kMinCurvature ? std::min(std::max(top, -0.5f), 0.5f) : 0.0f;
  }
}

// Writes edge pixels at `pixels`, without their chains.
class Placement {
 public:
  explicit Placement(const Gradient& gradient) : gradient_(gradient), width_(gradient.magnitude.width()) {}

  void run(const MaskPixel* pixels, int count, EdgePixel* out) {
    for (int i = 0; i < count; ++i) gather(pixels[i], i);
    place(around_, count, &sub_pixel_);
    for (int i = 0; i < count; ++i) {
      const float nx = sub_pixel_.nx[i], ny = sub_pixel_.ny[i], shift = sub_pixel_.shift[i];
      out[i] = {float(pixels[i].x) + shift * nx,
                float(pixels[i].y) + shift * ny,
                nx,
                ny,
                around_.here[i] / kSobelPerGrayLevel,
                0};
    }
  }

 private:
  void gather(MaskPixel p, int i) {
    const int dx = gradient_.dx.at(p.x, p.y), dy = gradient_.dy.at(p.x, p.y);
    const int x = dx > 0 ? 1 : -1, y = dy > 0 ? width_ : -width_;
    const float* m = &gradient_.magnitude.at(p.x, p.y);
    around_.dx[i] = float(dx), around_.dy[i] = float(dy), around_.here[i] = *m;
    around_.ahead_x[i] = m[x], around_.ahead_y[i] = m[y], around_.ahead_xy[i] = m[x + y];
    around_.behind_x[i] = m[-x], around_.behind_y[i] = m[-y], around_.behind_xy[i] = m[-x - y];
  }

  const Gradient& gradient_;
  int width_;
  Surroundings around_;
  SubPixel sub_pixel_;
};

// Drops flat pixels, which detectors other than Canny may mark.
PixelChains without_flat(PixelChains all, const Gradient& gradient) {
  const auto is_flat = [&](MaskPixel p) { return !(gradient.magnitude.at(p.x, p.y) >= kFlat); };
  if (std::none_of(all.pixels.begin(), all.pixels.end(), is_flat)) return all;
  PixelChains kept;
  kept.pixels.reserve(all.pixels.size());
  for (const EdgeChain& chain : all.chains) {
    const int begin = int(kept.pixels.size());
    for (int i = chain.begin; i < chain.end; ++i) {
      const MaskPixel p = all.pixels[size_t(i)];
      if (!is_flat(p)) kept.pixels.push_back(p);
    }
    kept.chains.push_back({begin, int(kept.pixels.size())});
  }
  return kept;
}

ImageEdges place_all(PixelChains chains, const Gradient& gradient) {
  ImageEdges map;
  map.width = gradient.magnitude.width();
  map.height = gradient.magnitude.height();
  const int count = int(chains.pixels.size());
  map.pixels.resize(count);
  Placement placement(gradient);
  for (int i = 0; i < count; i += kRun)
    placement.run(&chains.pixels[i], std::min(kRun, count - i), &map.pixels[i]);
  map.chains = std::move(chains.chains);
  for (size_t c = 0; c < map.chains.size(); ++c)
    for (int i = map.chains[c].begin; i < map.chains[c].end; ++i) map.pixels[i].chain = int(c);
  return map;
}

}  // namespace

ImageEdges extract_edges(const Plane<uint8_t>& mask, const Gradient& gradient, int min_chain) {
  return place_all(within_quota(without_flat(link_edges(mask, min_chain), gradient), gradient), gradient);
}

}  // namespace edgevo
