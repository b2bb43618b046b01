// SPDX-License-Identifier: BSD-3-Clause
#include "see_points.h"

#include <cmath>
#include <limits>

namespace edgevo {
namespace {

// Eq. (edgeerror): r = g(n)^T (p' - n(p')).
float edge_residual_px(const PyramidLevel& level, const Eigen::Vector2f& px) {
  const int nearest = level.field.nearest(px.x(), px.y());
  if (nearest < 0) return std::numeric_limits<float>::quiet_NaN();
  const EdgePixel& edge = level.edges.pixels[size_t(nearest)];
  return edge.normal().dot(px - edge.position());
}

}  // namespace

std::vector<SeenPoint> see_points(const ReferenceCloud& cloud, const SE3& T_cur_ref,
                                  const FramePyramid& current, double idepth_factor) {
  const PyramidLevel& finest = current.finest();
  std::vector<SeenPoint> seen;
  for (const CloudPoint& p : cloud.points) {
    // The point times its inverse depth: finite for a point at infinity, and z is idepth_ref / idepth_cur.
    const Eigen::Vector3d scaled = T_cur_ref.rotation() * p.ray + p.idepth * T_cur_ref.translation();
    if (!(scaled.z() > 0) || !(p.idepth > 0)) continue;
    const Eigen::Vector2d px = finest.pinhole.project(scaled);
    if (!finest.pinhole.contains(px)) continue;
    const double to_current = idepth_factor / scaled.z();
    SeenPoint point;
    point.px = px.cast<float>();
    point.idepth = float(p.idepth * to_current);
    point.idepth_sigma = float(p.idepth_sigma * to_current);
    point.residual_px = edge_residual_px(finest, point.px);
    seen.push_back(point);
  }
  return seen;
}

}  // namespace edgevo
