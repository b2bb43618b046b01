// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/carried_unit.h"

#include <gmock/gmock.h>

namespace edgevo {
namespace {

// A camera that turns by 3 degrees a frame; each tenth frame is a keyframe that adds `sigma`.
edgevo::Run turning(double sigma) {
  edgevo::Run run;
  for (int i = 0; i < 120; ++i) {
    FrameRecord frame;
    frame.index = i;
    frame.segment = 0;
    const Eigen::Quaterniond q(Eigen::AngleAxisd(i * 3 * M_PI / 180, Eigen::Vector3d::UnitY()));
    frame.T_world_cam = SE3(q, Eigen::Vector3d::Zero());
    if (i % 10 == 0) {
      frame.evidence.adjustment.emplace();
      frame.evidence.adjustment->unit_variance = sigma * sigma;
    }
    run.frames.push_back(frame);
  }
  return run;
}

TEST(CarriedUnit, APureRotationLeavesItUncertain) {
  const auto turns = pure_rotations(turning(0.1));
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_EQ(turns[0].first_frame, 0);
  EXPECT_GT(turns[0].sigma, 0.2);
  EXPECT_THAT(to_string(turns[0]), ::testing::HasSubstr("a pure rotation by 3"));
}

TEST(CarriedUnit, ATurnOnTheWayCarriesIt) { EXPECT_TRUE(pure_rotations(turning(0.004)).empty()); }

TEST(CarriedUnit, ALinkOverTheTurnCarriesIt) {
  edgevo::Run run = turning(0.1);
  run.constraints.push_back({"ground", 0, 119, 1, 0.02, true});
  EXPECT_TRUE(pure_rotations(run).empty());
}

}  // namespace
}  // namespace edgevo
