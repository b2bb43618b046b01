// SPDX-License-Identifier: BSD-3-Clause
// Shadows on the ground: each surface is projected along the rays of the sun, and the cells that it covers
// are dark.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "light_change.h"

namespace edgevo {
namespace {

constexpr double kCaster = 0.3;  // metres; what does not rise above it casts no shadow: ground, kerbs, steps
constexpr double kMargin = 40;   // metres around the ground's outline; a shadow beyond it is seen by nobody

double top(const Surface& s) {
  return s.origin.z() + std::max(0.0, s.side_u.z()) + std::max(0.0, s.side_v.z());
}

// Whether the surface exists at a, b of its sides.
bool exists_at(const Surface& s, const Texture& texture, double a, double b) {
  if (a < 0 || b < 0 || a > 1 || b > 1 || (s.is_triangle && a + b > 1)) return false;
  if (!texture.is_cut_out()) return true;
  const TextureLevel& level = texture.levels.front();
  const auto texel = [](double uv, int size) {
    return std::clamp(int((uv - std::floor(uv)) * size), 0, size - 1);
  };
  const int x = texel(s.uv_origin.x() + a * s.uv_size.x(), level.width);
  const int y = texel(s.uv_origin.y() + b * s.uv_size.y(), level.height);
  return level.alpha[size_t(y) * size_t(level.width) + size_t(x)] >= 128;
}

class ShadowCaster {
 public:
  ShadowCaster(const World& world, const Eigen::Vector3d& sun) : world_(world), sun_(sun) {
    Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    for (const Surface& s : world.surfaces)
      for (const Eigen::Vector3d& p : {s.origin, Eigen::Vector3d(s.origin + s.side_u + s.side_v)})
        low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>());
    shadow_.corner = low - Eigen::Vector2d::Constant(kMargin);
    const Eigen::Vector2d size = high - low + Eigen::Vector2d::Constant(2 * kMargin);
    shadow_.width = int(size.x() / shadow_.cell_m) + 1, shadow_.height = int(size.y() / shadow_.cell_m) + 1;
    shadow_.lit.assign(size_t(shadow_.width) * size_t(shadow_.height), 255);
  }

  GroundShadow cast() {
    for (const Surface& s : world_.surfaces)
      if (top(s) > kCaster) darken(s);
    soften();
    return std::move(shadow_);
  }

 private:
  // Shadow of a point, or of a side, which is the difference of two points.
  Eigen::Vector2d projected(const Eigen::Vector3d& p) const {
    return p.head<2>() - p.z() / sun_.z() * sun_.head<2>();
  }
  int cell(double x, int axis, int end) const {
    return std::clamp(int(std::floor((x - shadow_.corner[axis]) / shadow_.cell_m)), 0, end);
  }

  void darken(const Surface& s) {
    const Eigen::Vector2d o = projected(s.origin), u = projected(s.side_u), v = projected(s.side_v);
    Eigen::Matrix2d sides;
    sides << u, v;
    if (std::abs(sides.determinant()) < 1e-6) return;  // the sun shines along it
    const Eigen::Matrix2d inverse = sides.inverse();
    const Eigen::Vector2d low = o + u.cwiseMin(0) + v.cwiseMin(0), high = o + u.cwiseMax(0) + v.cwiseMax(0);
    const Texture& texture = world_.textures[size_t(s.texture)];
    for (int y = cell(low.y(), 1, shadow_.height); y < cell(high.y(), 1, shadow_.height); ++y)
      for (int x = cell(low.x(), 0, shadow_.width); x < cell(high.x(), 0, shadow_.width); ++x) {
        const Eigen::Vector2d p = shadow_.corner + shadow_.cell_m * Eigen::Vector2d(x, y);
        const Eigen::Vector2d ab = inverse * (p - o);
        if (exists_at(s, texture, ab.x(), ab.y())) lit(x, y) = 0;
      }
  }
  uint8_t& lit(int x, int y) { return shadow_.lit[size_t(y) * size_t(shadow_.width) + size_t(x)]; }

  // Mean over three cells in both directions: the sun is half a degree wide, 0.1 m over 10 m.
  void soften() {
    for (int pass = 0; pass < 2; ++pass) {
      const std::vector<uint8_t> sharp = shadow_.lit;
      const size_t step = pass == 0 ? 1 : size_t(shadow_.width);
      for (size_t i = step; i + step < sharp.size(); ++i)
        shadow_.lit[i] = uint8_t((sharp[i - step] + 2 * sharp[i] + sharp[i + step]) / 4);
    }
  }

  const World& world_;
  const Eigen::Vector3d sun_;
  GroundShadow shadow_;
};

}  // namespace

GroundShadow ground_shadow(const World& world, const Eigen::Vector3d& sun) {
  return ShadowCaster(world, sun).cast();
}

float GroundShadow::factor(float x, float y) const {
  const float cx = (x - float(corner.x())) / float(cell_m), cy = (y - float(corner.y())) / float(cell_m);
  const int x0 = int(std::floor(cx)), y0 = int(std::floor(cy));
  if (x0 < 0 || y0 < 0 || x0 + 1 >= width || y0 + 1 >= height) return 1;
  const float fx = cx - float(x0), fy = cy - float(y0);
  const uint8_t* row = lit.data() + size_t(y0) * size_t(width) + size_t(x0);
  const uint8_t* next = row + width;
  const float sun = (1 - fy) * ((1 - fx) * float(row[0]) + fx * float(row[1])) +
                    fy * ((1 - fx) * float(next[0]) + fx * float(next[1]));
  return shade + (1 - shade) * sun / 255;
}

}  // namespace edgevo
