// SPDX-License-Identifier: BSD-3-Clause
#include "unit_move.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

// Keyframes a unit apart along z, each with a point 10 ahead; from keyframe 3 on lengths have shrunk to a
// half.
class ShrunkMap : public ::testing::Test {
 protected:
  ShrunkMap() {
    double z = 0;
    for (int id = 0; id < 6; ++id) {
      Keyframe k;
      k.id = k.frame_index = id;
      if (id > 0) z += id > 2 ? 0.5 : 1;
      k.T_cam_world = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -z));
      MapPoint p;
      p.px = p.normal = {1, 0};
      p.idepth = 1 / (id > 2 ? 5.0 : 10.0);
      p.idepth_sigma = 0.1 * p.idepth;
      k.points.push_back(p);
      map_.add(std::move(k));
    }
    map_.begin_segment(0);
    map_.marginalise_oldest({});
    map_.marginalise_oldest({});
  }
  SE3 pose(int id) const {
    for (const Keyframe& k : map_.active())
      if (k.id == id) return k.T_cam_world;
    return map_.stored().at(id).keyframe->T_world_cam.inverse();
  }
  double step(int id) const { return (pose(id + 1) * pose(id).inverse()).translation().norm(); }
  void set_back() {
    map_.move(move_of_unit(map_, 2, 2), [](const Keyframe& k) { return k.pyramid; });
  }

  Map map_{Rectification(Pinhole{100, 100, 50, 50, 100, 100}), std::make_shared<MapLog>()};
};

TEST_F(ShrunkMap, LengthsSinceTheLastSureKeyframeAreThoseBefore) {
  set_back();
  for (int id = 0; id < 5; ++id) EXPECT_NEAR(step(id), 1, 1e-12) << id;
  for (const Keyframe& k : map_.active()) EXPECT_NEAR(k.points[0].idepth, 0.1, 1e-12) << k.id;
}

TEST_F(ShrunkMap, SureKeyframesKeepTheirShape) {
  const SE3 before = pose(1) * pose(0).inverse();
  set_back();
  EXPECT_LT((pose(1) * pose(0).inverse() * before.inverse()).log().norm(), 1e-12);
  EXPECT_FLOAT_EQ(map_.stored().at(0).keyframe->points[0].idepth, 0.1F);
}

// Nothing jumps for tracking.
TEST_F(ShrunkMap, TheNewestKeyframeStays) {
  const SE3 before = pose(5);
  set_back();
  EXPECT_LT((pose(5) * before.inverse()).log().norm(), 1e-12);
}

TEST_F(ShrunkMap, TheMoveSaysWhy) { EXPECT_EQ(move_of_unit(map_, 2, 2).reason, MoveReason::kUnit); }

}  // namespace
}  // namespace edgevo
