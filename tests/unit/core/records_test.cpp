// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/records.h"

#include <gtest/gtest.h>

#include "edgevo/core/doubtful_frame.h"

namespace edgevo {
namespace {

TEST(Records, WhatIsDegradedIsDoubtfulButDoesNotThrowDoubtOnTheMap) {
  FrameRecord frame;
  frame.state = TrackingState::kTracking;
  EXPECT_FALSE(is_doubtful(frame));  // p_right is not known
  frame.p_right = 0.99;
  EXPECT_FALSE(is_doubtful(frame));
  frame.state = TrackingState::kDegraded;
  EXPECT_TRUE(is_doubtful(frame));
  EXPECT_FALSE(is_map_in_doubt(frame));
  frame.p_right = 0.5;
  EXPECT_TRUE(is_map_in_doubt(frame));
}

TEST(Records, TheMapWorldIsZUpAndXForward) {
  EXPECT_TRUE((T_zup_world() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));   // forward
  EXPECT_TRUE((T_zup_world() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY()));  // right
  EXPECT_TRUE((T_zup_world() * Eigen::Vector3d::UnitY()).isApprox(-Eigen::Vector3d::UnitZ()));  // down
}

TEST(Records, ThePointOfAKeyframeLiesOnItsRayAtItsDepth) {
  const Pinhole pinhole{100, 200, 50, 60, 100, 120};
  EdgePoint p;
  p.px = {70, 20};
  p.idepth = 0.25f;
  EXPECT_TRUE(point_in_camera(pinhole, p).isApprox(Eigen::Vector3d(0.8, -0.8, 4), 1e-7));
}

TEST(Records, TheLeverArmOfTheMountNeedsMetres) {
  edgevo::Run run;
  EXPECT_EQ(T_map_world(run).matrix(), T_zup_world().matrix());
  run.T_vehicle_cam = SE3(T_zup_world().rotation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(T_map_world(run).translation(), Eigen::Vector3d::Zero());
  EXPECT_NE(unit_statement(run).find("arbitrary"), std::string::npos);
  run.scale_source = "odometry";
  EXPECT_EQ(T_map_world(run).translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(unit_statement(run), "metre (scale from odometry)");
  run.scale.sigma = 0.01;
  EXPECT_EQ(unit_statement(run), "metre (scale from odometry, +- 1.0 %)");
  run.scale.lowest = 0.9, run.scale.highest = 2.12;
  EXPECT_EQ(unit_statement(run), "metre (scale from odometry, UNCERTAIN: the factor ran from 0.90 to 2.12)");
}

}  // namespace
}  // namespace edgevo
