// SPDX-License-Identifier: BSD-3-Clause
// The copy of the map that the window draws.
#include "view_keyframes.h"

#include <gtest/gtest.h>

#include "edgevo/map/run_builder.h"
#include "support/made_events.h"

namespace edgevo {
namespace {

using test::MadeEvents;

class ViewKeyframesOfAMadeRun : public ::testing::Test {
 protected:
  void show(size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      for (const auto& event : events_.frames()[i]) {
        view_.apply(made_.run.pinhole, *event);
        builder_.apply(*event);
      }
  }
  const test::SyntheticRun made_ = test::synthetic_run();
  const MadeEvents events_{made_};
  ViewKeyframes view_;
  RunBuilder builder_{made_.run.pinhole};
};

TEST_F(ViewKeyframesOfAMadeRun, AreThoseOfTheFinishedRun) {
  show(0, MadeEvents::kMovedAfter);
  EXPECT_EQ(view_.moves(), 0);
  const edgevo::Run run = builder_.finish();
  ASSERT_EQ(view_.size(), run.keyframes.size());
  for (size_t k = 0; k < view_.size(); ++k) {
    const KeyframeRecord keyframe = view_.in_live_frame(k);
    EXPECT_EQ(keyframe.frame_index, run.keyframes[k].frame_index);
    EXPECT_EQ(keyframe.T_world_cam.translation(), run.keyframes[k].T_world_cam.translation());
    EXPECT_EQ(keyframe.points.back().idepth, run.keyframes[k].points.back().idepth);
  }
}

TEST_F(ViewKeyframesOfAMadeRun, MoveWithThePast) {
  show(0, MadeEvents::kMovedAfter);
  const KeyframeRecord before = view_.in_live_frame(7), of_first_segment = view_.in_live_frame(2);
  show(MadeEvents::kMovedAfter, MadeEvents::kMovedAfter + 1);
  EXPECT_EQ(view_.moves(), 1);
  const KeyframeRecord after = view_.in_live_frame(7);
  EXPECT_NEAR(double(after.points[0].idepth), double(before.points[0].idepth) / MadeEvents::kGrowth, 1e-6);
  // About the newest keyframe, whose pose does not change.
  const auto newest = made_.run.keyframes[12].T_world_cam.translation();
  EXPECT_NEAR((after.T_world_cam.translation() - newest).norm(),
              MadeEvents::kGrowth * (before.T_world_cam.translation() - newest).norm(), 1e-9);
  EXPECT_EQ(view_.in_live_frame(2).T_world_cam.translation(), of_first_segment.T_world_cam.translation());
}

// A unit that is found later moves the map in the world; the camera that is drawn with it has not jumped.
TEST(ViewKeyframes, StayUnderTheCameraWhenTheirUnitIsFound) {
  const auto at = [](double z) { return SE3(Eigen::Quaterniond::Identity(), {0, 0, z}); };
  const Pinhole pinhole = test::synthetic_run().run.pinhole;
  ViewKeyframes view;
  view.apply(pinhole, SegmentPlaced{});
  auto keyframe = std::make_shared<KeyframeRecord>();
  keyframe->segment = 0, keyframe->T_world_cam = at(10);
  view.apply(pinhole, KeyframeMarginalised{7, keyframe, {}});
  EpochsPlaced placed;
  placed.epochs = {{0, 0, -1, {}, 0}, {0, 1, 5, {2, at(-8)}, 0.1}};
  placed.T_odom_map = {2, at(-10)}, placed.T_world_odom = at(2);
  view.apply(pinhole, placed);
  EXPECT_EQ(view.moves(), 1);
  EXPECT_NEAR(view.in_live_frame(0).T_world_cam.translation().z(), 10, 1e-12);
}

}  // namespace
}  // namespace edgevo
