// SPDX-License-Identifier: BSD-3-Clause
// A run through a stop in traffic.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace edgevo
