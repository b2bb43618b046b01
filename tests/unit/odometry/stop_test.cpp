// SPDX-License-Identifier: BSD-3-Clause
// A run through a stop in traffic, and one that begins in it.
#include <gtest/gtest.h>

#include <algorithm>

#include "rendered_runs.h"
#include "support/pasted_body.h"

namespace edgevo {
namespace {

// A stop after 30 frames, in which a body comes that hides three fifths of the view.
TEST(AStop, BeforeTrafficKeepsThePose) {
  constexpr int kStop = 30, kStanding = 10;
  Odometry odometry(test::sweep_camera(), {}, {});
  for (int k = 0; k < kStop; ++k) odometry.process(test::sweep_frame(k));
  for (int k = 0; k < kStanding; ++k) {
    Frame frame = test::sweep_frame(kStop - 1);
    frame.index = kStop + k;
    frame.time = Timestamp::from_seconds(0.05 * frame.index);
    test::paste_body({-215.0 + 22 * k, 25, 215}, &frame.image);
    odometry.process(frame);
  }
  const auto run = odometry.finish();
  const FrameRecord &before = run.frames[kStop - 1], &last = run.frames.back();
  ASSERT_TRUE(last.T_world_cam);
  EXPECT_LT((last.T_world_cam->translation() - before.T_world_cam->translation()).norm(), 0.1)
      << "a hundredth of the depth";
  EXPECT_GT(last.evidence.inlier_share, 0.6) << "of what stands still";
}

// A camera that stands, while a body crosses that hides three fifths of its view, and then moves.
TEST(AStart, BeforeTrafficHasOnePoseForAllFramesInWhichItStood) {
  constexpr int kStanding = 40, kMoving = 30;
  Odometry odometry(test::sweep_camera(), {}, {});
  for (int k = 0; k < kStanding + kMoving; ++k) {
    Frame frame = test::sweep_frame(std::max(k - kStanding, 0));
    frame.index = k;
    frame.time = Timestamp::from_seconds(0.05 * k);
    if (k > 2 && k < kStanding) test::paste_body({-215.0 + 17 * (k - 3), 25, 215}, &frame.image);
    const FrameRecord record = odometry.process(frame);
    EXPECT_FALSE(k < kStanding && record.T_world_cam_live) << "no map of the body, " << k;
  }
  const auto run = odometry.finish();
  int stood = 0;
  for (int k = 0; k < kStanding; ++k) {
    ASSERT_TRUE(run.frames[size_t(k)].T_world_cam) << k;
    stood += run.frames[size_t(k)].evidence.stands;
  }
  EXPECT_GE(stood, kStanding - 3);
  const auto e = test::trajectory_error(run, 0, kStanding + kMoving,
                                        [](int k) { return test::sweep_pose(std::max(k - kStanding, 0)); });
  EXPECT_LT(e.rmse, 0.03 * e.length);
}

}  // namespace
}  // namespace edgevo
