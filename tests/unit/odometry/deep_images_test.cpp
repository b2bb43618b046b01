// SPDX-License-Identifier: BSD-3-Clause
// Images of more than 8 bits keep their pose where 8 bits would show nothing.
#include <gtest/gtest.h>

#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

constexpr int kDeepFrames = 100, kDimBegin = 45, kDimEnd = 75;

// As a camera of 12 bits shows it in `light` times the usual light.
Frame in_twelve_bits(Frame frame, double light) {
  frame.image.scale = {0, 16};
  for (uint8_t& gray : frame.image.pixels) {
    frame.image.values.push_back(uint16_t(std::lround(16 * light * gray)));
    gray = uint8_t(light * gray);
  }
  return frame;
}

// For 30 frames the light falls so far that 40 of 4096 values remain.
TEST(DeepImages, ADimIntervalKeepsItsPose) {
  Odometry odometry(test::sweep_camera());
  for (int k = 0; k < kDeepFrames; ++k)
    odometry.process(in_twelve_bits(test::sweep_frame(k), k >= kDimBegin && k < kDimEnd ? 40.0 / 4096 : 1));
  const auto run = odometry.finish();
  for (const FrameRecord& f : run.frames) {
    EXPECT_EQ(f.segment, 0) << f.index;
    EXPECT_NE(f.state, TrackingState::kLost) << f.index << " " << f.note;
  }
  const auto e = test::trajectory_error(run, 0, kDeepFrames, test::sweep_pose);
  EXPECT_EQ(e.poses, kDeepFrames);
  EXPECT_LT(e.rmse, 0.02 * e.length);
}

}  // namespace
}  // namespace edgevo
