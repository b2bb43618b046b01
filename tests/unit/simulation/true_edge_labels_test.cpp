// SPDX-License-Identifier: BSD-3-Clause
// True edges of simple worlds are where projection puts them, and nowhere else.
#include "edgevo/simulation/true_edge_labels.h"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "support/white_square.h"

namespace edgevo {
namespace {

Camera pinhole_camera() {
  Camera camera;
  camera.set_pinhole({300, 300, 160.3, 119.6, 320, 240});
  return camera;
}

Surface face(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v, int texture) {
  Surface s;
  s.origin = corner, s.side_u = u, s.side_v = v, s.texture = texture, s.is_two_sided = true;
  return s;
}

// The square of white_square() with other surfaces.
Scene scene_of(const std::vector<Surface>& surfaces, const std::vector<GrayImage>& textures,
               const Camera& camera) {
  Scene scene = test::white_square(camera);
  auto world = std::make_shared<World>(*scene.world);
  world->surfaces = surfaces;
  world->textures.clear();
  for (const GrayImage& image : textures) world->textures.push_back(make_texture(image));
  scene.world = world;
  return scene;
}

struct Segment {
  Eigen::Vector3d a, b;  // scene
  TrueEdge kind;
};

double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

// Every label lies on a segment of its kind, and every segment is labelled all along.
void expect_exactly(const Scene& scene, const std::vector<Segment>& segments) {
  constexpr double kSquare = 0.708;  // from the centre of a pixel to its corner
  const GrayImage labels = true_edge_labels(SceneRenderer(scene), 0);
  const Pinhole p = scene.camera.pinhole();
  const SE3 T_cam_scene = scene.T_scene_cam[0].inverse();
  const auto px = [&](const Eigen::Vector3d& X) { return p.project(T_cam_scene * X); };
  const auto label = [&](int u, int v) {
    return TrueEdge(labels.pixels[size_t(v) * size_t(p.width) + size_t(u)]);
  };
  for (int v = 0; v < p.height; ++v)
    for (int u = 0; u < p.width; ++u) {
      if (label(u, v) == TrueEdge::none) continue;
      double nearest = 1e9;
      for (const Segment& s : segments)
        if (s.kind == label(u, v))
          nearest = std::min(nearest, distance({double(u), double(v)}, px(s.a), px(s.b)));
      EXPECT_LE(nearest, kSquare) << u << " " << v << ": " << int(label(u, v));
    }
  for (const Segment& s : segments)
    for (double t = 0.1; t <= 0.9;
         t += 0.01) {  // at its ends another kind may win, or a face be thinner than the points
      const Eigen::Vector2d at = px(s.a) + t * (px(s.b) - px(s.a));
      const int u = int(std::lround(at.x())), v = int(std::lround(at.y()));
      bool found = false;
      for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du) found |= label(u + du, v + dv) == s.kind;
      EXPECT_TRUE(found) << at.transpose() << ": kind " << int(s.kind);
    }
}

TEST(TrueEdgeLabels, OutlineOfASquareIsADepthStep) {
  const Scene scene = test::white_square(pinhole_camera());
  const Surface& s = scene.world->surfaces[0];
  const Eigen::Vector3d a = s.origin, b = a + s.side_u, c = b + s.side_v, d = a + s.side_v;
  const TrueEdge step = TrueEdge::depth_step;
  expect_exactly(scene, {{a, b, step}, {b, c, step}, {c, d, step}, {d, a, step}});
}

TEST(TrueEdgeLabels, BoxHasCreasesWhereItsFacesMeetAndStepsAround) {
  // The corner of a box at (4, 0.1, 0.2): one face to the left, one to the right, one on top, seen from above
  // the top.
  const Eigen::Vector3d corner(4, 0.1, -0.2), left(1, 0.8, 0), right(1, -0.7, 0), down(0, 0, -0.6);
  const Scene scene =
      scene_of({face(corner, left, down, 0), face(corner, right, down, 0), face(corner, left, right, 0)},
               {{1, 1, {120}}}, pinhole_camera());
  const Eigen::Vector3d l = corner + left, r = corner + right, back = l + right;
  const TrueEdge step = TrueEdge::depth_step, crease = TrueEdge::crease;
  expect_exactly(scene, {{corner, l, crease},
                         {corner, r, crease},
                         {corner, corner + down, crease},
                         {l, back, step},
                         {back, r, step},
                         {l, l + down, step},
                         {r, r + down, step},
                         {l + down, corner + down, step},
                         {corner + down, r + down, step}});
}

TEST(TrueEdgeLabels, SeamOfOnePlaneIsNoEdgeAndAChangeOfGrayThereIsTexture) {
  const auto two_halves = [](int right_texture) {
    const Eigen::Vector3d half(0, -4, 0), down(0, 0, -8);
    return scene_of({face({4, 4, 4}, half, down, 0), face({4, 0, 4}, half, down, right_texture)},
                    {{1, 1, {100}}, {1, 1, {160}}}, pinhole_camera());
  };
  expect_exactly(two_halves(0), {});
  // At the border of the image there is no slope.
  expect_exactly(two_halves(1), {{{4, 0, 1.56}, {4, 0, -1.56}, TrueEdge::texture}});
}

TEST(TrueEdgeLabels, TextureOfOneSurfaceIsMarkedWhereItsGrayChanges) {
  GrayImage stripes{1024, 1, {}};
  for (int i = 0; i < 1024; ++i) stripes.pixels.push_back(i < 512 ? 60 : 180);
  const Scene scene = scene_of({face({4, 4, 4}, {0, -8, 0}, {0, 0, -8}, 0)}, {stripes}, pinhole_camera());
  const GrayImage labels = true_edge_labels(SceneRenderer(scene), 0);
  const Pinhole p = scene.camera.pinhole();
  // Texels are 0.6 px.
  for (int v = 2; v < p.height - 2; ++v) {
    int marked = 0;
    for (int u = 0; u < p.width; ++u) {
      const uint8_t label = labels.pixels[size_t(v) * size_t(p.width) + size_t(u)];
      if (label == 0) continue;
      EXPECT_EQ(label, uint8_t(TrueEdge::texture));
      EXPECT_NEAR(u, 160.3, 1);
      ++marked;
    }
    EXPECT_EQ(marked, 1) << "row " << v;
  }
}

TEST(TrueEdgeLabels, NoiseAndShutterDoNotMoveThem) {
  Scene scene = test::white_square(pinhole_camera());
  const GrayImage before = true_edge_labels(SceneRenderer(scene), 0);
  scene.noise_sigma = 20;
  EXPECT_EQ(true_edge_labels(SceneRenderer(scene), 0).pixels, before.pixels);
  scene.camera.set_distortion({-0.2, 0, 0, 0, 0});  // labels are those of the undistorted image
  EXPECT_EQ(true_edge_labels(SceneRenderer(scene), 0).pixels, before.pixels);
}

}  // namespace
}  // namespace edgevo
