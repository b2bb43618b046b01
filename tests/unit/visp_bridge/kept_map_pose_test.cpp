// SPDX-License-Identifier: BSD-3-Clause
// The two measurements of where a camera is in a kept map: a run's own map, and single images.
#include "edgevo/visp_bridge/kept_map_pose.h"

#include <gtest/gtest.h>

#include "edgevo/core/angle.h"
#include "map_of_desk.h"

namespace edgevo {
namespace {

using test::desk_frame;
using test::kDeskFrames;

struct Followed {
  int own = 0, by_image = 0, own_at_last = 0;  // frames
};

// Frames from `begin` on, as if each segment had been found in the map of all frames.
Followed follow(int begin) {
  edgevo::Run before;
  KeptMapTracker tracker(test::map_of_desk(&before));
  Odometry odometry(test::desk().camera(), servo_odometry_params(), {});
  Followed f;
  for (int i = begin; i < kDeskFrames; ++i) {
    odometry.process(desk_frame(i));
    const KeptMapPose pose = tracker.follow(odometry, true);
    f.own += pose.is_by_own_map, f.own_at_last += pose.is_by_own_map && i >= kDeskFrames - 20;
    if (!pose.by_image) continue;
    ++f.by_image;
    const SE3 off = pose.by_image->inverse() * *before.frames[size_t(i)].T_world_cam;
    EXPECT_LT(off.translation().norm(), 0.2) << "of a median depth of some 10, at " << i;
    EXPECT_LT(off.angle(), rad(0.5)) << i;
  }
  return f;
}

// The run that the map was kept of, once more: the same frame and unit.
TEST(KeptMapTracker, BelievesAMapThatImagesAgreeWith) {
  const Followed f = follow(0);
  EXPECT_EQ(f.own_at_last, 20);
  EXPECT_GE(f.by_image, 1) << "before there is a map";
}

// A run that begins elsewhere has another frame and unit, and has not been found.
TEST(KeptMapTracker, DoesNotBelieveAMapThatImagesContradict) {
  const Followed f = follow(14);
  EXPECT_EQ(f.own_at_last, 0);
  EXPECT_GE(f.by_image, 30);
}

}  // namespace
}  // namespace edgevo
