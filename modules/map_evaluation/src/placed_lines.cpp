// SPDX-License-Identifier: BSD-3-Clause
#include "placed_lines.h"

#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/evaluation/similarity_fit.h"

namespace edgevo {
namespace {

constexpr double kNearest = 0.05;  // metres: what is nearer to the camera is not drawn

double metres_per_unit(const Run& map, const Scene& scene) {
  std::vector<Eigen::Vector3d> from, to;
  for (const KeyframeRecord& k : map.keyframes) {
    if (k.frame_index < 0 || k.frame_index >= scene.size()) continue;
    from.push_back(k.T_world_cam.translation());
    to.push_back(scene.T_scene_cam[size_t(k.frame_index)].translation());
  }
  Points src(3, from.size()), dst(3, to.size());
  for (size_t i = 0; i < from.size(); ++i)
    src.col(Eigen::Index(i)) = from[i], dst.col(Eigen::Index(i)) = to[i];
  const std::optional<Sim3> fit = fit_sim3(src, dst);
  if (!fit)
    throw InputError("the map", "has no path to lay onto the scene's: fewer than three keyframes in it move",
                     "give the scene, and the seed, that the run was made with");
  return fit->scale;
}

// The part of a piece in front of the camera.
bool clip(Eigen::Vector3d* a, Eigen::Vector3d* b) {
  if (a->z() < kNearest && b->z() < kNearest) return false;
  const auto cut = [](Eigen::Vector3d* p, const Eigen::Vector3d& q) {
    if (p->z() < kNearest) *p += (kNearest - p->z()) / (q.z() - p->z()) * (q - *p);
  };
  cut(a, *b), cut(b, *a);
  return true;
}

}  // namespace

PlacedLines place_lines(const Run& map, const Scene& scene) {
  PlacedLines placed;
  placed.metres_per_unit = metres_per_unit(map, scene);
  for (const KeyframeRecord& k : map.keyframes) {
    if (k.frame_index < 0 || k.frame_index >= scene.size()) continue;
    placed.last_frame = std::max(placed.last_frame, k.frame_index);
    const SE3& T_scene_cam = scene.T_scene_cam[size_t(k.frame_index)];
    const auto in_scene = [&](const EdgeVertex& v) {
      return T_scene_cam * (placed.metres_per_unit * point_in_camera(map.pinhole, v));
    };
    for (const EdgeLine& line : k.lines)
      for (size_t i = 1; i < line.vertices.size(); ++i)
        placed.pieces.push_back({in_scene(line.vertices[i - 1]), in_scene(line.vertices[i]), line.source});
  }
  return placed;
}

std::vector<DrawnPixel> draw_lines(const PlacedLines& lines, const Pinhole& pinhole, const SE3& T_scene_cam) {
  const SE3 T_cam_scene = T_scene_cam.inverse();
  std::vector<DrawnPixel> drawn;
  double left = 0;  // of a pixel: short pieces count together
  for (size_t i = 0; i < lines.pieces.size(); ++i) {
    Eigen::Vector3d a = T_cam_scene * lines.pieces[i].a, b = T_cam_scene * lines.pieces[i].b;
    if (!clip(&a, &b)) continue;
    const Eigen::Vector2d from = pinhole.project(a), step = pinhole.project(b) - from;
    const double length = step.norm();
    if (!(length < 2.0 * (pinhole.width + pinhole.height))) continue;
    left += length;
    const int pixels = int(left);
    left -= pixels;
    for (int s = 0; s < pixels; ++s) {
      const double share = (s + 0.5) / pixels;
      const Eigen::Vector2d px = from + share * step;
      if (!pinhole.contains(px, 1)) continue;
      // Inverse depth is linear along the image of a straight line.
      const double depth = 1 / ((1 - share) / a.z() + share / b.z());
      drawn.push_back({px, Eigen::Vector2d(-step.y(), step.x()) / length, depth, i});
    }
  }
  return drawn;
}

}  // namespace edgevo
