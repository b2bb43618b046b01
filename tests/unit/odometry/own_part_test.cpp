// SPDX-License-Identifier: BSD-3-Clause
// What is fixed to the camera and found before there is a map.
#include <gtest/gtest.h>

#include <algorithm>

#include "edgevo/core/random.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

constexpr int kFrames = 60;

SE3 pose(int k) { return test::sweep_pose(2 * k); }

// A plate with a pattern over a quarter of the view, fixed to the camera.
Frame behind_a_plate(const test::HollowScene& scene, int k) {
  GrayImage image = scene.render(pose(k), 1, 0, 1.5, uint64_t(k + 1));
  Random random(3);
  constexpr int kBlock = 12;
  for (int y = image.height / 2; y + kBlock <= image.height; y += kBlock)
    for (int x = image.width / 2; x + kBlock <= image.width; x += kBlock) {
      const auto gray = uint8_t(40 + random.below(180));
      for (int v = 0; v < kBlock; ++v)
        std::fill_n(image.pixels.begin() + (y + v) * image.width + x, kBlock, gray);
    }
  return {k, Timestamp::from_seconds(0.05 * k), std::move(image)};
}

// Seen again without it, they are views of the map, or get poses that none of its edges has a part in.
TEST(OwnPart, FramesBeforeItWasFoundAreSeenAgain) {
  const test::HollowScene scene(5, 320, 240, 0.15, 0.9);
  OdometryParams params;
  params.mapping.bootstrap.min_disparity = 0.1;  // a map takes longer than the part
  Odometry odometry(scene.camera, params);
  int first_masked = -1, first_pose = -1;
  for (int k = 0; k < kFrames; ++k) {
    const FrameRecord record = odometry.process(behind_a_plate(scene, k));
    if (first_masked < 0 && odometry.ego_mask()) first_masked = k;
    if (first_pose < 0 && record.T_world_cam_live) first_pose = k;
  }
  const auto run = odometry.finish();
  ASSERT_GT(first_masked, 0);
  EXPECT_LE(first_pose, first_masked + 5);
  const auto early = test::trajectory_error(run, 0, first_masked, pose);
  EXPECT_EQ(early.poses, first_masked);
  EXPECT_LT(early.rmse, 0.005 * early.length);
  EXPECT_EQ(test::trajectory_error(run, 0, kFrames, pose).poses, kFrames);
}

}  // namespace
}  // namespace edgevo
