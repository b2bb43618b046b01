// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/simulation/scene.h"

namespace edgevo {
namespace {

// True if the segment from a to b crosses the surface.
bool crosses(const Surface& s, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d normal = s.side_u.cross(s.side_v);
  const double da = normal.dot(a - s.origin), db = normal.dot(b - s.origin);
  if ((da > 0) == (db > 0)) return false;
  const Eigen::Vector3d p = a + (b - a) * (da / (da - db)) - s.origin;
  const double u = s.side_v.cross(normal).dot(p) / normal.squaredNorm();
  const double v = normal.cross(s.side_u).dot(p) / normal.squaredNorm();
  return u >= 0 && v >= 0 && u <= 1 && v <= 1 && (!s.is_triangle || u + v <= 1);
}

}  // namespace

std::optional<int> wall_crossed(const Scene& scene) {
  for (int i = 0; i + 1 < scene.size(); ++i) {
    const Eigen::Vector3d& a = scene.T_scene_cam[size_t(i)].translation();
    const Eigen::Vector3d& b = scene.T_scene_cam[size_t(i) + 1].translation();
    for (const Surface& s : scene.world->surfaces)
      if (s.is_solid && crosses(s, a, b)) return i;
  }
  return std::nullopt;
}

void check_trajectory(const Scene& scene, const std::string& where) {
  const std::optional<int> frame = wall_crossed(scene);
  if (!frame) return;
  throw InputError(where,
                   "the camera passes through a wall between frames " + std::to_string(*frame) + " and " +
                       std::to_string(*frame + 1),
                   "move the waypoints, or change motion.lane_offset or world.density");
}

}  // namespace edgevo
