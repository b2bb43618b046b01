// SPDX-License-Identifier: BSD-3-Clause
#include "view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lens_rays.h"

namespace edgevo {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;

// The part of a convex polygon where plane.dot(p) >= offset.
Polygon clip(const Polygon& polygon, const Eigen::Vector3d& plane, double offset) {
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = plane.dot(a) - offset, db = plane.dot(b) - offset;
    if (da >= 0) kept.push_back(a);
    if ((da >= 0) != (db >= 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

// Least and largest x, then y, in normalised coordinates, that the image rows from `top` to `bottom` look
// along; lens distortion included.
Eigen::Vector4d view_limits(const Camera& camera, double top, double bottom) {
  const Pinhole p = camera.pinhole();
  Eigen::Vector4d limits(1e9, -1e9, 1e9, -1e9);
  for (int i = 0; i <= 8; ++i) {
    const double u = i / 8.0 * p.width, v = top + i / 8.0 * (bottom - top);
    for (const Eigen::Vector2d& px : {Eigen::Vector2d(-1, v), Eigen::Vector2d(p.width, v),
                                      Eigen::Vector2d(u, top), Eigen::Vector2d(u, bottom)}) {
      const Eigen::Vector2d x = camera.unproject(px).value_or(p.ray(px)).hnormalized();
      limits[0] = std::min(limits[0], x.x()), limits[1] = std::max(limits[1], x.x());
      limits[2] = std::min(limits[2], x.y()), limits[3] = std::max(limits[3], x.y());
    }
  }
  return limits;
}

// Wholly inside the view: what most surfaces are, and what needs no clipping.
bool is_inside(const Polygon& polygon, const Eigen::Vector4d& limits) {
  return std::all_of(polygon.begin(), polygon.end(), [&](const Eigen::Vector3d& p) {
    return p.z() >= kNear && p.x() >= limits[0] * p.z() && p.x() <= limits[1] * p.z() &&
           p.y() >= limits[2] * p.z() && p.y() <= limits[3] * p.z();
  });
}

Polygon clip_to_view(Polygon polygon, const Eigen::Vector4d& limits) {
  if (is_inside(polygon, limits)) return polygon;
  polygon = clip(polygon, {0, 0, 1}, kNear);
  polygon = clip(polygon, {1, 0, -limits[0]}, 0);
  polygon = clip(polygon, {-1, 0, limits[1]}, 0);
  polygon = clip(polygon, {0, 1, -limits[2]}, 0);
  return clip(polygon, {0, -1, limits[3]}, 0);
}

// True for a sphere that no ray within the limits meets: a quick test before the exact one.
bool is_out_of_view(const Eigen::Vector3d& centre, double radius, const Eigen::Vector4d& limits) {
  const double x = centre.x(), y = centre.y(), z = centre.z();
  const auto outside = [&](double distance, double slope) {
    return distance < -radius * std::sqrt(1 + slope * slope);
  };
  return z < -radius || outside(x - limits[0] * z, limits[0]) || outside(limits[1] * z - x, limits[1]) ||
         outside(y - limits[2] * z, limits[2]) || outside(limits[3] * z - y, limits[3]);
}

// Smaller than half a pixel across: most sample points miss it.
bool is_speck(const Eigen::Vector3d& centre, double radius, const Pinhole& p) {
  return 2 * radius * std::max(p.fx, p.fy) < 0.5 * centre.norm();
}

// Bounds in the image of a polygon in front of the camera. A distorting lens bends its sides: they are
// sampled.
void bound(const Polygon& polygon, const Camera& camera, ViewSurface* view) {
  const Pinhole p = camera.pinhole();
  const int steps = camera.has_distortion() ? 8 : 1;
  Eigen::Array2d low(1e9, 1e9), high(-1e9, -1e9);
  for (size_t i = 0; i < polygon.size(); ++i)
    for (int k = 0; k < steps; ++k) {
      const Eigen::Vector3d point =
          polygon[i] + (polygon[(i + 1) % polygon.size()] - polygon[i]) * (double(k) / steps);
      const Eigen::Array2d px = camera.project(point)->array();
      low = low.min(px), high = high.max(px);
    }
  // Samples reach half a pixel beyond the centre; between the sampled points a bent side may bulge.
  const double margin = camera.has_distortion() ? 2.5 : 0.5;
  view->col_begin = std::clamp(int(std::ceil(low.x() - margin)), 0, p.width);
  view->col_end = std::clamp(int(std::floor(high.x() + margin)) + 1, 0, p.width);
  view->row_begin = std::clamp(int(std::ceil(low.y() - margin)), 0, p.height);
  view->row_end = std::clamp(int(std::floor(high.y() + margin)) + 1, 0, p.height);
}

// The same for a polygon seen through a face of the cube, in whose axes it is given. Its sides are sampled at
// steps of the face, not of their length, since a side may reach from close by to the horizon.
void bound_in_face(const Polygon& polygon, const Camera& camera, int face, double max_angle,
                   ViewSurface* view) {
  constexpr double kStep =
      0.12;  // of a face from -1 to 1: 7 degrees, over which a side bulges by a pixel or two
  constexpr double kMargin = 2.5;
  const Eigen::Matrix3d& R = R_cam_face()[size_t(face)];
  Eigen::Array2d low(1e9, 1e9), high(-1e9, -1e9);
  bool is_whole = face == kFaces - 1;  // the outline of what lies behind may surround the whole image
  for (size_t i = 0; i < polygon.size() && !is_whole; ++i) {
    const Eigen::Vector2d a = polygon[i].hnormalized(), b = polygon[(i + 1) % polygon.size()].hnormalized();
    const int steps = int((b - a).norm() / kStep) + 1;
    for (int k = 0; k < steps; ++k) {
      const Eigen::Vector3d ray = R * Eigen::Vector2d(a + (b - a) * (double(k) / steps)).homogeneous();
      const auto px = camera.project(ray);
      if (!px || std::atan2(ray.head<2>().norm(), ray.z()) > max_angle) {
        is_whole = true;
        break;
      }
      low = low.min(px->array()), high = high.max(px->array());
    }
  }
  if (is_whole) low.setZero(), high = Eigen::Array2d(camera.width, camera.height);
  view->col_begin = std::clamp(int(std::ceil(low.x() - kMargin)), 0, camera.width);
  view->col_end = std::clamp(int(std::floor(high.x() + kMargin)) + 1, 0, camera.width);
  view->row_begin = std::clamp(int(std::ceil(low.y() - kMargin)), 0, camera.height);
  view->row_end = std::clamp(int(std::floor(high.y() + kMargin)) + 1, 0, camera.height);
}

// Solves f.x (u - cx)/fx + f.y (v - cy)/fy + f.z >= 0 for the column u.
void set_limits(const Pinhole& p, ViewSurface* view) {
  for (const Eigen::Vector3d& f : view->inside) {
    const double a = f.x() / p.fx, b = f.y() / p.fy, c = f.z() - a * p.cx - b * p.cy;
    if (a > 0)
      view->left[view->left_count++] = {-b / a, -c / a};
    else if (a < 0)
      view->right[view->right_count++] = {-b / a, -c / a};
    else
      view->always[view->always_count++] = {b, c};
  }
}

// N, A, B and the texture's functions, from the parallelogram in the camera frame.
void set_functions(const Eigen::Vector3d& origin, const Eigen::Vector3d& side_u,
                   const Eigen::Vector3d& side_v, ViewSurface* view) {
  const Eigen::Vector3d normal = side_u.cross(side_v);
  const Eigen::Vector3d dual_u = side_v.cross(normal) / normal.squaredNorm();
  const Eigen::Vector3d dual_v = normal.cross(side_u) / normal.squaredNorm();
  const Eigen::Vector3d N = normal / normal.dot(origin);
  const Eigen::Vector3d A = dual_u - dual_u.dot(origin) * N;
  const Eigen::Vector3d B = dual_v - dual_v.dot(origin) * N;
  view->idepth = N;
  view->inside[0] = A, view->inside[1] = N - A, view->inside[2] = B, view->inside[3] = N - B;
  view->inside[4] = Eigen::Vector3d(-N.x(), -N.y(), 1 / kNear - N.z());
  const Surface& s = *view->surface;
  view->idepth_f = N.cast<float>();
  if (s.is_triangle) view->inside[1] = view->inside[3] = N - A - B;
  view->u = (view->texture->width() * (s.uv_origin.x() * N + s.uv_size.x() * A)).cast<float>();
  view->v = (view->texture->height() * (s.uv_origin.y() * N + s.uv_size.y() * B)).cast<float>();
}

// What a view sees along its axis z > 0, and how its surfaces are bounded in the image.
struct Frustum {
  Eigen::Vector4d limits, row_limits;  // of the image, and of the rows
  Pinhole pinhole;
  RowRange rows;
};

// `bound` sets the rows and columns of a view, given the polygon that is seen.
template <class Bound>
std::vector<ViewSurface> surfaces_in(const World& world, const Frustum& frustum, const SE3& T_scene_view,
                                     const Bound& bound) {
  const SE3 T_view_scene = T_scene_view.inverse();
  const Eigen::Matrix3d R = T_view_scene.R();
  const Eigen::Vector3d eye = T_scene_view.translation();
  const RowRange& rows = frustum.rows;
  std::vector<ViewSurface> views;
  for (const Surface& s : world.surfaces) {
    // side_u right, side_v down: the normal points away from who sees the front.
    const double facing = s.side_u.cross(s.side_v).dot(s.origin - eye);
    if (std::abs(facing) < 1e-9 || (facing < 0 && !s.is_two_sided)) continue;
    const Eigen::Vector3d diagonal = s.side_u + s.side_v;
    const Eigen::Vector3d middle = R * (s.origin + 0.5 * diagonal - eye);
    const double radius =
        0.5 * std::sqrt(std::max(diagonal.squaredNorm(), (s.side_u - s.side_v).squaredNorm()));
    if (is_out_of_view(middle, radius, frustum.row_limits) || is_speck(middle, radius, frustum.pinhole))
      continue;
    const Eigen::Vector3d origin = R * (s.origin - eye), u = R * s.side_u, v = R * s.side_v;
    Polygon outline{origin, origin + u, origin + u + v, origin + v};
    if (s.is_triangle) outline.erase(outline.begin() + 2);
    const Polygon seen = clip_to_view(std::move(outline), frustum.limits);
    if (seen.empty()) continue;
    ViewSurface view;
    bound(seen, &view);
    if (std::max(view.row_begin, rows.begin) >= std::min(view.row_end, rows.end) ||
        view.col_begin >= view.col_end)
      continue;
    view.surface = &s;
    view.gain = s.gain;
    view.texture = &world.textures[size_t(s.texture)];
    view.distance = middle.norm();
    set_functions(origin, u, v, &view);
    set_limits(frustum.pinhole, &view);
    views.push_back(view);
  }
  return views;
}

}  // namespace

std::vector<ViewSurface> view_surfaces(const World& world, const Camera& camera, const SE3& T_scene_cam,
                                       RowRange rows) {
  constexpr double kMargin = 3;  // rows: samples reach beyond the centre, and a lens bends rows
  const double bottom = camera.pinhole().height;
  const Frustum frustum{
      view_limits(camera, -1, bottom),
      view_limits(camera, std::max(-1.0, rows.begin - kMargin), std::min(bottom, rows.end + kMargin)),
      camera.pinhole(), rows};
  return surfaces_in(world, frustum, T_scene_cam,
                     [&](const Polygon& seen, ViewSurface* view) { bound(seen, camera, view); });
}

std::vector<ViewSurface> view_surfaces_in_face(const World& world, const Camera& camera, int face,
                                               const SE3& T_scene_cam, RowRange rows) {
  constexpr double kSide = 1.001;  // a little beyond the face, so that no seam opens
  const Eigen::Vector4d limits(-kSide, kSide, -kSide, kSide);
  const double max_angle = camera.max_angle();
  return surfaces_in(
      world, {limits, limits, camera.pinhole(), rows}, T_scene_face(T_scene_cam, face),
      [&](const Polygon& seen, ViewSurface* view) { bound_in_face(seen, camera, face, max_angle, view); });
}

SE3 T_scene_face(const SE3& T_scene_cam, int face) {
  return T_scene_cam * SE3(R_cam_face()[size_t(face)], Eigen::Vector3d::Zero());
}

ViewSurface view_sky(const World& world, const SE3& T_scene_cam) {
  static const Surface layer = [] {
    Surface s;
    s.is_tiled = true;
    return s;
  }();
  constexpr double kHeight = 1000, kTile = 1800;  // metres
  ViewSurface view;
  view.surface = &layer;
  view.texture = &world.textures[size_t(world.sky.texture)];
  const Eigen::Matrix3d R = T_scene_cam.R().transpose();
  set_functions(R * Eigen::Vector3d(0, 0, kHeight), R * Eigen::Vector3d(kTile, 0, 0),
                R * Eigen::Vector3d(0, kTile, 0), &view);
  return view;
}

}  // namespace edgevo
