// SPDX-License-Identifier: BSD-3-Clause
// Images that a driver hands out twice.
#include <gtest/gtest.h>

#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

// A driver that hands out each image twice: no frame is lost, and the camera does not stand now and then.
TEST(RepeatedImages, HaveThePoseOfTheOneBefore) {
  constexpr int kImages = 40;
  Odometry odometry(test::sweep_camera());
  for (int k = 0; k < 2 * kImages; ++k) {
    Frame frame = test::sweep_frame(k / 2);
    frame.index = k, frame.time = Timestamp::from_seconds(0.025 * k);
    odometry.process(frame);
  }
  const auto run = odometry.finish();
  ASSERT_EQ(run.frames.size(), size_t(2 * kImages));
  int repeated = 0;
  for (size_t k = 1; k < run.frames.size(); k += 2) {
    const FrameRecord &frame = run.frames[k], &before = run.frames[k - 1];
    if (frame.evidence.fault != ImageFault::kRepeated || !before.T_world_cam_live) continue;
    if (!frame.T_world_cam_live) continue;  // of the bootstrap, whose poses are found afterwards
    ASSERT_TRUE(frame.T_world_cam) << k;
    ++repeated;
    EXPECT_EQ(frame.state, before.state) << k;
    EXPECT_NEAR((frame.T_world_cam->translation() - before.T_world_cam->translation()).norm(), 0, 0.05) << k;
  }
  EXPECT_GE(repeated, kImages - 5);
  const auto e = test::trajectory_error(run, 0, 2 * kImages, [](int k) { return test::sweep_pose(k / 2); });
  EXPECT_LT(e.rmse, 0.03 * e.length);
}

}  // namespace
}  // namespace edgevo
