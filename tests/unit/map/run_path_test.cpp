// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/run_path.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

// A keyframe in the window, at `z` on the axis of the first.
WindowAdjusted::Active active(int id, double z) {
  WindowAdjusted::Active k;
  k.id = id;
  k.keyframe.T_world_cam = SE3(Eigen::Quaterniond::Identity(), {0, 0, z});
  return k;
}

// A place of a kept map can be seen before its keyframe leaves the window.
TEST(RunPath, KnowsTheKeyframesOfTheWindowOnceOneIsInAKeptMap) {
  RunPath path;
  path.marginalised[0] = {0, 0, 0, SE3()};
  path.marginalised[3] = {3, 0, 9, SE3(Eigen::Quaterniond::Identity(), {0, 0, 3})};
  path.window.keyframes = std::make_shared<const std::vector<WindowAdjusted::Active>>(
      std::vector<WindowAdjusted::Active>{active(3, 7), active(5, 5)});
  EXPECT_EQ(path.keyframes().size(), 2U);
  Constraint found;
  found.to = NodeId::keyframe(5);
  found.failure = Constraint::Failure{0.01, Matrix7d::Identity()};
  path.epochs.add({0, found});
  const std::vector<KeyframeInMap> all = path.keyframes();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].id, 3);
  EXPECT_EQ(all[1].T_map_cam.translation().z(), 3);  // as it left the window
  EXPECT_EQ(all[2].id, 5);
  EXPECT_EQ(all[2].T_map_cam.translation().z(), 5);
}

// So the newest pose is in the frame and unit of a kept map as soon as a keyframe of the window is found
// there.
TEST(RunPath, PlacesTheWindowInAKeptMap) {
  RunPath path;
  SegmentPlaced began;
  path.epochs.begin_segment(began, Sim3());
  path.window.keyframes = std::make_shared<const std::vector<WindowAdjusted::Active>>(
      std::vector<WindowAdjusted::Active>{active(0, 0), active(1, 1), active(2, 2)});
  const Sim3 T_kept_run{2,
                        SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY())), {3, 1, 0})};
  for (int id = 0; id < 3; ++id) {
    Constraint c;
    c.kind = ConstraintKind::kPlace;
    c.to = NodeId::keyframe(id);
    c.T_from_to = T_kept_run * Sim3{1, SE3(Eigen::Quaterniond::Identity(), {0, 0, double(id)})};
    c.covariance = 1e-4 * Matrix7d::Identity();
    path.epochs.add({id, c});
  }
  const PlacedEpochs placed =
      path.epochs.solve_keyframes(path.run_so_far([](int, int) { return 0; }), path.keyframes());
  EXPECT_LT((placed.epochs.back().T_world_map * T_kept_run.inverse()).log().norm(), 1e-3);
}

}  // namespace
}  // namespace edgevo
