// SPDX-License-Identifier: BSD-3-Clause
#include "scene_views.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kGround = 0.3;  // metres; a level surface below it takes shadows

bool is_ground(const Surface& s) {
  return std::abs(s.side_u.z()) + std::abs(s.side_v.z()) < 1e-9 && s.origin.z() < kGround;
}

float factor(const Light& light, size_t surface) { return light.gain.empty() ? 1 : light.gain[surface]; }

// Lights views of the world, whose rays are in axes of the pose `T_scene_view`.
void light_views(const LightChange& change, const World& world, const SE3& T_scene_view, double seconds,
                 std::vector<ViewSurface>* views) {
  const float share = float(change.share(seconds));
  const Eigen::Matrix<float, 2, 3> ground = T_scene_view.R().topRows<2>().cast<float>();
  for (ViewSurface& view : *views) {
    const size_t i = size_t(view.surface - world.surfaces.data());
    view.gain *= (1 - share) * factor(change.first, i) + share * factor(change.second, i);
    view.takes_shadows = is_ground(*view.surface);
    view.ground = ground;
  }
}

// `look` returns the surfaces of a world for a pose of the camera in it, with rays in axes of the pose
// `T_scene_view`.
template <class Look>
SceneViews view_all(const Scene& scene, const Instant& at, const SE3& T_scene_view, const Look& look) {
  SceneViews views{look(*scene.world, at.T_scene_cam), {}};
  if (scene.light_change)
    light_views(*scene.light_change, *scene.world, T_scene_view, at.seconds, &views.surfaces);
  views.body.assign(views.surfaces.size(), kNoBody);
  for (size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const std::vector<ViewSurface> parts =
        look(*body.parts, body.T_scene_body(at.seconds).inverse() * at.T_scene_cam);
    views.surfaces.insert(views.surfaces.end(), parts.begin(), parts.end());
    views.body.resize(views.surfaces.size(), int(i));
  }
  return views;
}

}  // namespace

double seconds_of_frame(const Scene& scene, int index) {
  if (scene.bodies.empty() && !scene.light_change) return 0;
  return scene.times[std::min(size_t(index), scene.times.size() - 1)].seconds();
}

Instant instant_of(const Scene& scene, int index) {
  return {scene.T_scene_cam[size_t(index)], seconds_of_frame(scene, index)};
}

SceneViews view_scene(const Scene& scene, const Camera& camera, const Instant& at, RowRange rows) {
  return view_all(scene, at, at.T_scene_cam, [&](const World& world, const SE3& T_world_cam) {
    return view_surfaces(world, camera, T_world_cam, rows);
  });
}

SceneViews view_scene_in_face(const Scene& scene, const Camera& camera, int face, const Instant& at,
                              RowRange rows) {
  return view_all(scene, at, T_scene_face(at.T_scene_cam, face),
                  [&](const World& world, const SE3& T_world_cam) {
                    return view_surfaces_in_face(world, camera, face, T_world_cam, rows);
                  });
}

}  // namespace edgevo
