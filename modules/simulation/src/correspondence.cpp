// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/correspondence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edgevo {
namespace {

constexpr double kOneSurface = 0.02;  // inverse depths of one surface differ by less within a pixel, relative

double idepth_at(const ImageView<float>& depth, int x, int y) {
  const double z = double(depth.at(x, y));
  return z > 0 ? 1 / z : 0;
}

// Largest inverse depth of the pixels within one of (x, y).
double nearest_idepth(const ImageView<float>& depth, int x, int y) {
  double nearest = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, depth.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, depth.width - 1); ++u)
      nearest = std::max(nearest, idepth_at(depth, u, v));
  return nearest;
}

bool contains(const ImageView<float>& depth, const Eigen::Vector2d& px) {
  return px.x() >= 0 && px.y() >= 0 && px.x() <= depth.width - 1 && px.y() <= depth.height - 1;
}

// The four pixels around a position inside the image, as the upper left one.
Eigen::Vector2i cell_of(const ImageView<float>& depth, const Eigen::Vector2d& px) {
  return {std::clamp(int(px.x()), 0, std::max(depth.width - 2, 0)),
          std::clamp(int(px.y()), 0, std::max(depth.height - 2, 0))};
}

// True if one of the pixels around `px` has the inverse depth `expected`.
bool has_surface(const ImageView<float>& depth, const Eigen::Vector2d& px, double expected,
                 double tolerance) {
  const Eigen::Vector2i cell = cell_of(depth, px);
  for (int dv = 0; dv <= 1; ++dv)
    for (int du = 0; du <= 1; ++du) {
      const double q = idepth_at(depth, std::min(cell.x() + du, depth.width - 1),
                                 std::min(cell.y() + dv, depth.height - 1));
      if (std::abs(q - expected) <= tolerance * expected) return true;
    }
  return false;
}

}  // namespace

double edge_idepth(const ImageView<float>& depth, const Eigen::Vector2d& px) {
  if (!contains(depth, px)) return std::numeric_limits<double>::quiet_NaN();
  const int x = int(std::lround(px.x())), y = int(std::lround(px.y()));
  const double nearest = nearest_idepth(depth, x, y);
  if (depth.width < 2 || depth.height < 2) return nearest;
  const Eigen::Vector2i cell = cell_of(depth, px);
  const double a = px.x() - cell.x(), b = px.y() - cell.y();
  const double q00 = idepth_at(depth, cell.x(), cell.y()), q10 = idepth_at(depth, cell.x() + 1, cell.y());
  const double q01 = idepth_at(depth, cell.x(), cell.y() + 1),
               q11 = idepth_at(depth, cell.x() + 1, cell.y() + 1);
  const bool is_one_surface = std::min({q00, q10, q01, q11}) >= (1 - kOneSurface) * nearest;
  return is_one_surface ? (q00 * (1 - a) + q10 * a) * (1 - b) + (q01 * (1 - a) + q11 * a) * b : nearest;
}

Correspondence find_correspondence(const ViewPair& views, const Eigen::Vector2d& px, double tolerance) {
  Correspondence c;
  const double idepth = edge_idepth(views.depth_from, px);
  if (!(idepth >= 0)) return c;
  c.idepth = idepth;
  const Eigen::Vector3d Y = views.T_to_from.R() * views.pinhole.ray(px) +
                            idepth * views.T_to_from.translation();  // scaled by 1 / z_from
  if (!(Y.z() > 0)) return c;
  c.px = views.pinhole.project(Y);
  c.in_view = contains(views.depth_to, c.px);
  c.visible = c.in_view && has_surface(views.depth_to, c.px, idepth / Y.z(), tolerance);
  return c;
}

}  // namespace edgevo
