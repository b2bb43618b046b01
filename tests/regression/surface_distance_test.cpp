// SPDX-License-Identifier: BSD-3-Clause
// The distance to surfaces against the renderer: what is visible exists, and what is cut out does not.
#include "surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgevo/simulation/scene_renderer.h"

namespace edgevo::test {
namespace {

double distance_to_any(const World& world, const Eigen::Vector3d& p, double limit) {
  double least = limit;
  for (const Surface& s : world.surfaces) least = std::min(least, distance_to(world, s, p, least));
  return least;
}

TEST(SurfaceDistance, VisibleSurfacesExist) {
  const SceneRenderer renderer(load_scene("street"));
  const Pinhole pinhole = renderer.camera().pinhole();
  constexpr int kEvery = 97;          // pixels: no divisor of a row
  constexpr double kNearby = 30;      // metres: a pixel is narrower than the squares that are tested
  constexpr double kTolerance = 0.1;  // metres: a square of 5 cm and its neighbour
  int tested = 0;
  for (const int frame : {0, 40, 80}) {
    const std::vector<float> depth = renderer.render_depth(frame);
    for (size_t pixel = 0; pixel < depth.size(); pixel += kEvery) {
      const double z = double(depth[pixel]);
      if (!(z > 0 && z < kNearby)) continue;
      const Eigen::Vector2d px(double(pixel % size_t(pinhole.width)), double(pixel / size_t(pinhole.width)));
      const Eigen::Vector3d p = renderer.scene().T_scene_cam[size_t(frame)] * (z * pinhole.ray(px));
      ASSERT_LT(distance_to_any(*renderer.scene().world, p, 1), kTolerance)
          << px.transpose() << ", " << z << " m";
      ++tested;
    }
  }
  EXPECT_GT(tested, 5000);
}

// The corners of crowns and the air over the bonnets of cars.
TEST(SurfaceDistance, CutOutPartsDoNotExist) {
  const SceneRenderer renderer(load_scene("street"));
  const World& world = *renderer.scene().world;
  int crowns = 0;
  for (const Surface& s : world.surfaces) {
    if (s.is_solid || s.side_u.norm() < 4 || s.side_v.norm() < 4) continue;
    EXPECT_GT(distance_to(world, s, s.origin, 1), 0.1);
    EXPECT_LT(distance_to(world, s, s.origin + 0.5 * (s.side_u + s.side_v), 1), 0.5);
    ++crowns;
  }
  EXPECT_GT(crowns, 5);
}

}  // namespace
}  // namespace edgevo::test
