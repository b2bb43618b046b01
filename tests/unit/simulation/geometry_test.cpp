// SPDX-License-Identifier: BSD-3-Clause
// Depth, poses and pixel centres of rendered frames are exact.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "edgevo/simulation/scene_renderer.h"
#include "support/white_square.h"

namespace edgevo {
namespace {

float depth_at(const std::vector<float>& depth, int width, int u, int v) {
  return depth[size_t(v) * width + u];
}

// The 5x5 pixels around (u, v) lie on one surface: their inverse depth is linear to `tolerance`.
bool is_flat(const std::vector<float>& depth, int width, int height, int u, int v) {
  if (u < 2 || v < 2 || u >= width - 2 || v >= height - 2) return false;
  const double q = 1 / double(depth_at(depth, width, u, v));
  for (int dv = -2; dv <= 2; ++dv)
    for (int du = -2; du <= 2; ++du) {
      const double a = 1 / double(depth_at(depth, width, u + du, v + dv)),
                   b = 1 / double(depth_at(depth, width, u - du, v - dv));
      if (!(std::abs(a + b - 2 * q) < 1e-4 * q)) return false;
    }
  return true;
}

// Inverse depth, bilinear: exact on a plane.
double depth_between(const std::vector<float>& depth, int width, const Eigen::Vector2d& px) {
  const int u = int(px.x()), v = int(px.y());
  const double x = px.x() - u, y = px.y() - v;
  const auto q = [&](int du, int dv) { return 1 / double(depth_at(depth, width, u + du, v + dv)); };
  return 1 / ((q(0, 0) * (1 - x) + q(1, 0) * x) * (1 - y) + (q(0, 1) * (1 - x) + q(1, 1) * x) * y);
}

struct Agreement {
  int compared = 0, good = 0;
};

// Every flat pixel of frame i, transferred to frame j; points more than 2 % behind the depth there are
// hidden.
Agreement compare(const SceneRenderer& renderer, int i, int j) {
  const Pinhole p = renderer.camera().pinhole();
  const std::vector<float> from = renderer.render_depth(i), to = renderer.render_depth(j);
  const SE3 T_j_i = renderer.T_world_cam(j).inverse() * renderer.T_world_cam(i);
  Agreement result;
  for (int v = 2; v < p.height - 2; ++v)
    for (int u = 2; u < p.width - 2; ++u) {
      const double z = double(depth_at(from, p.width, u, v));
      if (z <= 0 || !is_flat(from, p.width, p.height, u, v)) continue;
      const Eigen::Vector3d point = T_j_i * (z * p.ray({double(u), double(v)}));
      if (point.z() < 0.1) continue;
      const Eigen::Vector2d px = p.project(point);
      if (!p.contains(px, 3) ||
          !is_flat(to, p.width, p.height, int(std::lround(px.x())), int(std::lround(px.y()))))
        continue;
      const double error = point.z() / depth_between(to, p.width, px) - 1;
      if (error > 0.02) continue;
      ++result.compared;
      result.good += std::abs(error) < 1e-3;
    }
  return result;
}

class SceneGeometry : public ::testing::TestWithParam<const char*> {};

TEST_P(SceneGeometry, ReprojectedDepthMeetsTheNextFrame) {
  const SceneRenderer renderer(load_scene(GetParam()));
  const int pixels = renderer.camera().pinhole().width * renderer.camera().pinhole().height;
  for (int i : {0, renderer.size() / 3, 2 * renderer.size() / 3}) {
    const Agreement a = compare(renderer, i, i + 1);
    EXPECT_GT(a.compared, pixels / 8) << "frame " << i;
    EXPECT_GE(a.good, 0.99 * a.compared) << "frame " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneGeometry,
                         ::testing::Values("street", "desk", "lakeshore", "corridor", "rotation",
                                           "circuit_short", "desk_revisit", "corridor_revisit",
                                           "identical_doors", "mirrored_street"));

// Where a horizontal (or vertical) line of pixels passes through gray 110, between dark and bright, going
// along it.
double crossing(const GrayImage& image, int u, int v, int du, int dv) {
  for (;; u += du, v += dv) {
    const double a = image.view().at(u, v), b = image.view().at(u + du, v + dv);
    if (a < 110 && b >= 110) return (du ? u : v) + (du + dv) * (110 - a) / (b - a);
  }
}

// The sides of the square near its upper left corner give that corner, to be compared with its projection.
Eigen::Vector2d corner_seen(const GrayImage& image, const Eigen::Vector2d& guess) {
  const int u = int(guess.x()), v = int(guess.y());
  return {crossing(image, u - 12, v + 6, 1, 0), crossing(image, u + 6, v - 12, 0, 1)};
}

TEST(PixelCentres, CornerIsSeenWhereItProjects) {
  Camera camera;
  camera.set_pinhole({410.3, 405.7, 158.61, 121.37, 320, 240});
  const Eigen::Vector2d expected = camera.pinhole().project({-0.611, -0.327, 4});
  const Eigen::Vector2d seen =
      corner_seen(SceneRenderer(test::white_square(camera)).render_image(0), expected);
  EXPECT_NEAR(seen.x(), expected.x(), 0.06);
  EXPECT_NEAR(seen.y(), expected.y(), 0.06);
}

TEST(PixelCentres, CornerIsSeenWhereTheLensPutsIt) {
  Camera camera;
  camera.set_pinhole({310.3, 305.7, 158.61, 121.37, 320, 240});
  camera.set_distortion({-0.25, 0.06, 0.001, -0.002, 0});
  const Eigen::Vector2d expected = camera.project({-0.611, -0.327, 4}).value();
  const Eigen::Vector2d seen =
      corner_seen(SceneRenderer(test::white_square(camera)).render_image(0), expected);
  // The sides are bent: their crossings lie six pixels from the corner.
  EXPECT_NEAR(seen.x(), expected.x(), 0.1);
  EXPECT_NEAR(seen.y(), expected.y(), 0.1);
}

TEST(RenderedDepth, IsTheDistanceAlongTheAxis) {
  Camera camera;
  camera.set_pinhole({100, 100, 31.5, 31.5, 64, 64});
  const std::vector<float> depth = SceneRenderer(test::white_square(camera)).render_depth(0);
  EXPECT_FLOAT_EQ(depth_at(depth, 64, 31, 31), 4.0f);
  EXPECT_FLOAT_EQ(depth_at(depth, 64, 20, 28), 4.0f);
  EXPECT_EQ(depth_at(depth, 64, 0, 0), 0.0f);  // sky
}

}  // namespace
}  // namespace edgevo
