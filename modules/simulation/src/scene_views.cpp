// SPDX-License-Identifier: BSD-3-Clause
#include "scene_views.h"

#include <algorithm>

namespace edgevo {
namespace {

// `look` returns the surfaces of a world for a pose of the camera in it.
template <class Look>
SceneViews view_all(const Scene& scene, const Instant& at, const Look& look) {
  SceneViews views{look(*scene.world, at.T_scene_cam), {}};
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

double seconds_of_bodies(const Scene& scene, int index) {
  if (scene.bodies.empty()) return 0;
  return scene.times[std::min(size_t(index), scene.times.size() - 1)].seconds();
}

Instant instant_of(const Scene& scene, int index) {
  return {scene.T_scene_cam[size_t(index)], seconds_of_bodies(scene, index)};
}

SceneViews view_scene(const Scene& scene, const Camera& camera, const Instant& at, RowRange rows) {
  return view_all(scene, at, [&](const World& world, const SE3& T_world_cam) {
    return view_surfaces(world, camera, T_world_cam, rows);
  });
}

SceneViews view_scene_in_face(const Scene& scene, const Camera& camera, int face, const Instant& at,
                              RowRange rows) {
  return view_all(scene, at, [&](const World& world, const SE3& T_world_cam) {
    return view_surfaces_in_face(world, camera, face, T_world_cam, rows);
  });
}

}  // namespace edgevo
