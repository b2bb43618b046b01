// SPDX-License-Identifier: BSD-3-Clause
// Exact correspondences: against planes with known projection, against rendered images, and for points
// without one.
#include "edgevo/simulation/correspondence.h"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/simulation/correspondence_export.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

constexpr int kWidth = 64, kHeight = 48;
const Pinhole kPinhole{60, 60, 31.5, 23.5, kWidth, kHeight};

std::vector<float> constant_depth(float z) { return std::vector<float>(size_t(kWidth) * kHeight, z); }

ImageView<float> view(const std::vector<float>& depth) { return {depth.data(), kWidth, kHeight, kWidth}; }

SE3 shift(double x, double y, double z) { return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, y, z)}; }

TEST(Correspondence, AWallSeenFromTheSide) {
  const std::vector<float> depth = constant_depth(4);
  const ViewPair views{kPinhole, view(depth), view(depth), shift(-0.5, 0, 0)};
  const Correspondence c = find_correspondence(views, {20.25, 10.75});
  EXPECT_TRUE(c.visible);
  EXPECT_NEAR(c.idepth, 0.25, 1e-9);
  EXPECT_NEAR(c.px.x(), 20.25 - 60 * 0.5 / 4, 1e-9);
  EXPECT_NEAR(c.px.y(), 10.75, 1e-9);
}

TEST(Correspondence, WhatLeavesTheImageIsNotInView) {
  const std::vector<float> depth = constant_depth(4);
  const ViewPair views{kPinhole, view(depth), view(depth), shift(-0.5, 0, 0)};
  EXPECT_FALSE(find_correspondence(views, {3, 10}).in_view);
  EXPECT_FALSE(find_correspondence(views, {-1, 10}).in_view);
  EXPECT_FALSE(find_correspondence(views, {NAN, 10}).in_view);
  const ViewPair past{kPinhole, view(depth), view(depth), shift(0, 0, -5)};
  EXPECT_FALSE(find_correspondence(past, {30, 20}).in_view) << "behind the camera";
}

TEST(Correspondence, WhatIsHiddenIsNotVisible) {
  const std::vector<float> far = constant_depth(4), near = constant_depth(2);
  const ViewPair views{kPinhole, view(far), view(near), SE3()};
  const Correspondence c = find_correspondence(views, {30, 20});
  EXPECT_TRUE(c.in_view);
  EXPECT_FALSE(c.visible);
}

TEST(Correspondence, TheSkyTurnsButDoesNotMove) {
  const std::vector<float> sky = constant_depth(0);
  const ViewPair moved{kPinhole, view(sky), view(sky), shift(1, 2, 3)};
  const Correspondence c = find_correspondence(moved, {30, 20});
  EXPECT_TRUE(c.visible);
  EXPECT_EQ(c.idepth, 0);
  EXPECT_NEAR((c.px - Eigen::Vector2d(30, 20)).norm(), 0, 1e-9);
}

TEST(Correspondence, AnEdgeBelongsToTheNearerSurface) {
  std::vector<float> depth = constant_depth(8);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x <= 30; ++x) depth[size_t(y) * kWidth + x] = 2;
  EXPECT_NEAR(edge_idepth(view(depth), {30.5, 20}), 0.5, 1e-9);
  EXPECT_NEAR(edge_idepth(view(depth), {31.2, 20}), 0.5, 1e-9) << "within a pixel";
  EXPECT_NEAR(edge_idepth(view(depth), {33.0, 20}), 0.125, 1e-9);
}

TEST(Correspondence, InverseDepthOfASlantIsInterpolated) {
  std::vector<float> depth(size_t(kWidth) * kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      depth[size_t(y) * kWidth + x] = float(1 / (0.2 + 0.0005 * x + 0.0003 * y));
  EXPECT_NEAR(edge_idepth(view(depth), {20.3, 10.6}), 0.2 + 0.0005 * 20.3 + 0.0003 * 10.6, 1e-6);
  EXPECT_NEAR(edge_idepth(view(depth), {63, 47}), 0.2 + 0.0005 * 63 + 0.0003 * 47, 1e-6) << "the last pixel";
}

// Rendered frames: the surface points found through the depth images must show the same brightness in both.
TEST(Correspondence, RenderedPointsLookAlike) {
  const SceneRenderer renderer(load_scene("desk"));
  const RenderedFrame a = renderer.render(10), b = renderer.render(13);
  Camera camera = renderer.camera();
  const Pinhole p = camera.pinhole();
  const ViewPair views{p,
                       {a.depth.data(), p.width, p.height, p.width},
                       {b.depth.data(), p.width, p.height, p.width},
                       b.T_world_cam.inverse() * a.T_world_cam};
  const auto gray = [&](const GrayImage& image, const Eigen::Vector2d& px) {
    const Eigen::Vector2d raw = camera.project(p.ray(px)).value();
    const int u = int(std::lround(raw.x())), v = int(std::lround(raw.y()));
    return u < 0 || v < 0 || u >= p.width || v >= p.height ? -1 : int(image.view().at(u, v));
  };
  int compared = 0, alike = 0;
  for (int v = 20; v < p.height - 20; v += 5)
    for (int u = 20; u < p.width - 20; u += 5) {
      const Correspondence c = find_correspondence(views, {double(u), double(v)});
      const int from = gray(a.image, {double(u), double(v)}), to = c.visible ? gray(b.image, c.px) : -1;
      if (from < 0 || to < 0) continue;
      ++compared;
      alike += std::abs(from - to) < 25;
    }
  ASSERT_GT(compared, 3000);
  EXPECT_GT(alike, 0.9 * compared);
}

// Against brute force: of all pixels of the second view, the one whose point is nearest to the pixel in the
// first view, at its depth.
TEST(Correspondence, MeetsTheSamePointOfTheOtherView) {
  const SceneRenderer renderer(load_scene("corridor"));
  const std::vector<float> from = renderer.render_depth(5), to = renderer.render_depth(7);
  const Pinhole p = renderer.camera().pinhole();
  const SE3 T_to_from = renderer.T_world_cam(7).inverse() * renderer.T_world_cam(5),
            T_from_to = T_to_from.inverse();
  const ViewPair views{
      p, {from.data(), p.width, p.height, p.width}, {to.data(), p.width, p.height, p.width}, T_to_from};
  int compared = 0;
  for (int v = 40; v < p.height - 40; v += 60)
    for (int u = 40; u < p.width - 40; u += 60) {
      const Correspondence c = find_correspondence(views, {double(u), double(v)});
      if (!c.visible || !(c.idepth > 0)) continue;
      double best = 1e9;
      Eigen::Vector2d best_px;
      for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
          const Eigen::Vector3d point =
              T_from_to * (double(to[size_t(y) * p.width + x]) * p.ray({double(x), double(y)}));
          if (!(point.z() > 0) || std::abs(point.z() * c.idepth - 1) > 0.1) continue;
          const double d = (p.project(point) - Eigen::Vector2d(u, v)).norm();
          if (d < best) best = d, best_px = {double(x), double(y)};
        }
      EXPECT_LT((c.px - best_px).norm(), 1.0) << u << ", " << v;
      ++compared;
    }
  EXPECT_GT(compared, 10);
}

// A grid of them, which need not lie on edges.
std::vector<Eigen::Vector2d> some_pixels(const GrayImage& image) {
  std::vector<Eigen::Vector2d> pixels;
  for (int y = 2; y < image.height; y += 7)
    for (int x = 2; x < image.width; x += 7) pixels.emplace_back(x + 0.25, y);
  return pixels;
}

TEST(CorrespondenceExport, OneFileAPair) {
  const test::TempFolder folder;
  const SceneRenderer renderer(load_scene("corridor"));
  int done = 0;
  export_correspondences(renderer, folder.path(), 3, 5, some_pixels, [&](int d) { done = d; });
  EXPECT_EQ(done, 1);
  std::istringstream text(read_file(folder / "correspondences/000003.csv", ""));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "x,y,x_next,y_next,visible");
  int rows = 0, visible = 0;
  while (std::getline(text, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 4) << line;
    ++rows;
    visible += line.back() == '1';
  }
  EXPECT_GT(rows, 1000);
  EXPECT_GT(visible, rows / 2);
  EXPECT_THROW(read_file(folder / "correspondences/000004.csv", ""), InputError)
      << "the last frame has no next one";
  EXPECT_THROW(export_correspondences(renderer, folder.path(), 3, 4, some_pixels), InputError);
}

}  // namespace
}  // namespace edgevo
