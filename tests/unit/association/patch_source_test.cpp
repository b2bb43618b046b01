// SPDX-License-Identifier: BSD-3-Clause
// The level from which a patch is cut is as coarse as the target sees the patch.
#include "edgevo/association/patch_source.h"

#include <gtest/gtest.h>

#include "edgevo/association/patch_comparison.h"
#include "edgevo/association/warp.h"
#include "support/plane_scene.h"

namespace edgevo {
namespace {

Eigen::Matrix2d scaled(double scale) { return scale * Eigen::Matrix2d::Identity(); }

int level_of(const FramePyramid& host, double scale) {
  return int(patch_source(host, {100, 60}, scaled(scale)).level - host.levels.data());
}

TEST(PatchSource, SelectsTheLevelWithPixelsClosestInSize) {
  const auto host = test::PlaneScene().pyramid(SE3());
  ASSERT_FALSE(host->levels[1].gradient_magnitude.empty());
  EXPECT_EQ(level_of(*host, 2.0), 0);
  EXPECT_EQ(level_of(*host, 1.0), 0);
  EXPECT_EQ(level_of(*host, 0.62), 0);
  EXPECT_EQ(level_of(*host, 0.58), 1);
  EXPECT_EQ(level_of(*host, 0.32), 1);
  const PatchSource half = patch_source(*host, {100, 60}, scaled(0.5));
  EXPECT_EQ(half.px, Eigen::Vector2d(50, 30));
  EXPECT_EQ(half.A_target_host, scaled(1.0));
}

TEST(PatchSource, SelectsNoLevelWithoutGradients) {
  const test::PlaneScene scene;
  EdgeParams params;
  params.edge_levels = 1;
  const auto bare = PyramidBuilder(scene.camera, params).build(scene.render(SE3()));
  EXPECT_EQ(level_of(*bare, 0.1), 0);
  const auto host = scene.pyramid(SE3());
  EXPECT_LT(level_of(*host, 0.01), int(host->levels.size()));
}

// A camera that backed away to more than twice the distance: patches of the selected level resemble its image
// more than those of the finest level do.
TEST(PatchSource, APatchSeenFromAfarLooksAlike) {
  const test::PlaneScene scene;
  const SE3 T_host_target(Eigen::Quaterniond::Identity(), {0, 0, -6});
  const auto host = scene.pyramid(SE3()), target = scene.pyramid(T_host_target);
  const Pinhole camera = scene.camera.pinhole();
  const PatchComparison& comparison = gradient_comparison();
  double finest = 0, chosen = 0;
  int tested = 0;
  for (size_t i = 0; i < host->finest().edges.pixels.size(); i += 7) {
    const Eigen::Vector2d px = host->finest().edges.pixels[i].position().cast<double>();
    const double idepth = scene.idepth(SE3(), px);
    const Eigen::Matrix2d A = patch_warp(camera, T_host_target.inverse(), px, idepth);
    const Eigen::Vector2d seen = camera.project(camera.ray(px) + idepth * Eigen::Vector3d(0, 0, 6));
    const PatchSource source = patch_source(*host, px, A);
    ASSERT_EQ(source.level, &host->levels[1]);
    Patch from_finest, from_chosen;
    if (!comparison.cut(host->finest(), px, A, 2, &from_finest) ||
        !comparison.cut(*source.level, source.px, source.A_target_host, 2, &from_chosen))
      continue;
    finest += comparison.cost(from_finest, target->finest(), seen.x(), seen.y());
    chosen += comparison.cost(from_chosen, target->finest(), seen.x(), seen.y());
    ++tested;
  }
  ASSERT_GT(tested, 50);
  EXPECT_LT(chosen, 0.7 * finest) << chosen / tested << " against " << finest / tested;
}

}  // namespace
}  // namespace edgevo
