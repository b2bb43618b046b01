// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The simplest scene: one white square, 4 m in front of the camera.
#include <memory>

#include "edgevo/simulation/scene.h"

namespace edgevo::test {

/// A square of gray 200 on a background of gray 20, seen by a camera at the origin that looks along x; one
/// frame.
inline Scene white_square(const Camera& camera) {
  auto world = std::make_shared<World>();
  world->textures.push_back(make_texture({1, 1, {200}}));
  world->sky.gray = 20;
  Surface square;
  square.origin = {4, 0.611, 0.327};  // upper left corner
  square.side_u = {0, -1.1, 0};
  square.side_v = {0, 0, -0.7};
  world->surfaces.push_back(square);
  Scene scene;
  scene.name = "white square";
  scene.camera = camera;
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  scene.T_scene_cam = {{R, Eigen::Vector3d::Zero()}};
  scene.times = {Timestamp{}};
  scene.world = world;
  return scene;
}

}  // namespace edgevo::test
