// SPDX-License-Identifier: BSD-3-Clause
#include "surface_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace edgevo::test {
namespace {

constexpr double kGrain = 0.05;   // metres: side of the squares of a cut-out that are tested
constexpr int kOpaqueAlpha = 32;  // mean alpha of a square with an eighth of it opaque: single leaves

bool is_near_ball(const Surface& s, const Eigen::Vector3d& p, double limit) {
  const Eigen::Vector3d middle = s.origin + 0.5 * (s.side_u + s.side_v);
  return (p - middle).norm() <= limit + 0.5 * (s.side_u.norm() + s.side_v.norm());
}

// Coordinates of `p` along the two sides, 0 to 1 inside.
Eigen::Vector2d along_sides(const Surface& s, const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 3, 2> sides;
  sides << s.side_u, s.side_v;
  return (sides.transpose() * sides).inverse() * (sides.transpose() * (p - s.origin));
}

// By clamping the coordinates in the plane: exact for rectangles.
double distance_to_whole(const Surface& s, const Eigen::Vector3d& p) {
  Eigen::Vector2d ab = along_sides(s, p).cwiseMax(0).cwiseMin(1);
  if (s.is_triangle && ab.sum() > 1) ab /= ab.sum();
  return (s.origin + ab.x() * s.side_u + ab.y() * s.side_v - p).norm();
}

bool exists(const Texture& texture, double u, double v, double texel_m, double size_m) {
  size_t level = 0;
  for (double grain = size_m / texture.width(); grain < texel_m && level + 1 < texture.levels.size(); ++level)
    grain *= 2;
  const TextureLevel& t = texture.levels[level];
  const int x = std::clamp(int(std::floor(u * t.width)), 0, t.width - 1),
            y = std::clamp(int(std::floor(v * t.height)), 0, t.height - 1);
  return t.alpha[size_t(y) * size_t(t.width) + size_t(x)] >= kOpaqueAlpha;
}

// The nearest square of kGrain that exists, of those within `limit`.
double distance_to_cut_out(const Texture& texture, const Surface& s, const Eigen::Vector3d& p, double limit) {
  const Eigen::Vector2d at = along_sides(s, p), size(s.side_u.norm(), s.side_v.norm());
  const Eigen::Array2d cells = (size / kGrain).array().ceil().max(1);
  const Eigen::Array2d reach = limit / size.array();
  const Eigen::Array2d from = ((at.array() - reach) * cells).floor().max(0),
                       to = ((at.array() + reach) * cells).ceil().min(cells);
  double least = limit;
  for (double j = from.y(); j < to.y(); ++j)
    for (double i = from.x(); i < to.x(); ++i) {
      const Eigen::Vector2d ab = (Eigen::Array2d(i, j) + 0.5) / cells;
      const double d = (s.origin + ab.x() * s.side_u + ab.y() * s.side_v - p).norm();
      if (d >= least) continue;
      const Eigen::Vector2d uv = s.uv_origin + s.uv_size.cwiseProduct(ab);
      if (exists(texture, uv.x(), uv.y(), kGrain, size.x() / std::abs(s.uv_size.x()))) least = d;
    }
  return least;
}

}  // namespace

double distance_to(const World& world, const Surface& s, const Eigen::Vector3d& p, double limit) {
  if (!is_near_ball(s, p, limit)) return limit;
  const double whole = distance_to_whole(s, p);
  const Texture& texture = world.textures[size_t(s.texture)];
  return whole >= limit || !texture.is_cut_out() ? whole : distance_to_cut_out(texture, s, p, limit);
}

}  // namespace edgevo::test
