// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Surfaces of a scene at an instant: those of its world, then those of its bodies.
#include <vector>

#include "edgevo/simulation/scene.h"
#include "view.h"

namespace edgevo {

/// Where the camera and the bodies are.
struct Instant {
  SE3 T_scene_cam;
  /// Time of the scene, for its bodies.
  double seconds = 0;
};

/// Time of bodies and light in frame `index`, or the last one; 0 if nothing but the camera changes.
double seconds_of_frame(const Scene& scene, int index);
/// The instant of frame `index`.
Instant instant_of(const Scene& scene, int index);

/// Number of a surface's body; -1: the world.
constexpr int kNoBody = -1;

/// Surfaces with the body that each belongs to.
struct SceneViews {
  std::vector<ViewSurface> surfaces;
  std::vector<int> body;
};

/// As view_surfaces(), in the light of that instant.
SceneViews view_scene(const Scene& scene, const Camera& camera, const Instant& at, RowRange rows);
/// As view_surfaces_in_face(), in the light of that instant.
SceneViews view_scene_in_face(const Scene& scene, const Camera& camera, int face, const Instant& at,
                              RowRange rows);

}  // namespace edgevo
