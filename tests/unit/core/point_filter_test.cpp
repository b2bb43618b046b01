// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/point_filter.h"

#include <gtest/gtest.h>

#include <limits>

namespace edgevo {
namespace {

EdgePoint point(float idepth, float sigma, int observations) {
  EdgePoint p;
  p.px = {10, 20};
  p.normal = {1, 0};
  p.idepth = idepth;
  p.idepth_sigma = sigma;
  p.observations = observations;
  return p;
}

TEST(PointFilter, KeepsPointsAtTheLimitAndDropsThoseBeyond) {
  PointFilter filter;
  filter.max_relative_sigma = 0.25;
  filter.min_observations = 2;
  EXPECT_TRUE(filter.keeps(point(0.5f, 0.125f, 2)));
  EXPECT_FALSE(filter.keeps(point(0.5f, 0.126f, 2)));
  EXPECT_FALSE(filter.keeps(point(0.5f, 0.125f, 1)));
}

TEST(PointFilter, BrokenPointsNeverPass) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const PointFilter filter;
  EXPECT_FALSE(filter.keeps(point(0, 0.001f, 9)));
  EXPECT_FALSE(filter.keeps(point(-1, 0.001f, 9)));
  EXPECT_FALSE(filter.keeps(point(nan, 0.001f, 9)));
  EXPECT_FALSE(filter.keeps(point(1, nan, 9)));
  EXPECT_FALSE(filter.keeps(point(1, 0, 9))) << "a sigma of 0 means unknown";
  EXPECT_FALSE(filter.keeps(point(std::numeric_limits<float>::infinity(), 0.001f, 9)));
}

TEST(PointFilter, CountsEachPointOnceUnderItsFirstReason) {
  edgevo::Run run;
  run.keyframes.resize(2);
  run.keyframes[0].points = {point(1, 0.01f, 5), point(-1, 9, 0), point(1, 9, 0)};
  run.keyframes[1].points = {point(1, 0.01f, 1), point(2, 0.01f, 3)};
  const PointCounts n = count_points(run, PointFilter());
  EXPECT_EQ(n.total, 5);
  EXPECT_EQ(n.kept, 2);
  EXPECT_EQ(n.invalid, 1);
  EXPECT_EQ(n.uncertain, 1);
  EXPECT_EQ(n.unconfirmed, 1);
}

TEST(MapWorld, WithoutAMountTheCameraLooksStraightAhead) {
  const SE3 T = T_map_world(edgevo::Run());
  EXPECT_TRUE((T * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE((T * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, -1, 0)));
  EXPECT_TRUE((T * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(0, 0, -1)));
}

TEST(MapWorld, LeverArmOfTheMountNeedsMetres) {
  edgevo::Run run;
  run.T_vehicle_cam = SE3(T_zup_world().rotation(), Eigen::Vector3d(0.5, 0, 1.6));
  EXPECT_TRUE(T_map_world(run).translation().isZero());
  run.scale_source = "odometry";
  EXPECT_TRUE(T_map_world(run).translation().isApprox(Eigen::Vector3d(0.5, 0, 1.6)));
}

}  // namespace
}  // namespace edgevo
