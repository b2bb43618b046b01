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
  constexpr int kStanding = 40, kMoving = 30, kBlank = 10;
  Odometry odometry(test::sweep_camera(), {}, {});
  for (int k = 0; k < kStanding + kMoving; ++k) {
    Frame frame = test::sweep_frame(std::max(k - kStanding, 0));
    frame.index = 2 * k;  // every second frame of a source
    frame.time = Timestamp::from_seconds(0.05 * k);
    if (k == kBlank) std::fill(frame.image.pixels.begin(), frame.image.pixels.end(), uint8_t(0));
    if (k > 2 && k < kStanding && k != kBlank)
      test::paste_body({-215.0 + 17 * (k - 3), 25, 215}, &frame.image);
    const FrameRecord record = odometry.process(frame);
    EXPECT_FALSE(k < kStanding && record.T_world_cam_live) << "no map of the body, " << k;
  }
  const auto run = odometry.finish();
  int stood = 0;
  for (int k = 0; k < kStanding; ++k) {
    const FrameRecord &frame = run.frames[size_t(k)], &middle = run.frames[kStanding / 2];
    if (k == kBlank) continue;
    ASSERT_TRUE(frame.T_world_cam) << k;
    stood += frame.evidence.stands;
    if (frame.evidence.stands && middle.evidence.stands) {
      EXPECT_NEAR((frame.T_world_cam->translation() - middle.T_world_cam->translation()).norm(), 0, 1e-9)
          << k;
    }
  }
  EXPECT_FALSE(run.frames[kBlank].T_world_cam) << "nothing was seen";
  EXPECT_NE(run.frames[kBlank].note, "");
  EXPECT_GE(stood, kStanding - 3);
  const auto e = test::trajectory_error(run, 0, 2 * (kStanding + kMoving), [](int k) {
    return test::sweep_pose(std::max(k / 2 - kStanding, 0));
  });
  EXPECT_LT(e.rmse, 0.03 * e.length);
}

}  // namespace
}  // namespace edgevo
