// SPDX-License-Identifier: BSD-3-Clause
// map, odom and base_link against matrices; covariances against small motions.
#include "live_frames.h"

#include <gmock/gmock.h>

#include "support/pose_matchers.h"

namespace edgevo {
namespace {

const SE3 kMount(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {1.5, 0.2, 1.1});
const SE3 kPose(Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized())),
                {1, -2, 5});

EpochsPlaced placed_at(const SE3& T_world_odom) {
  EpochsPlaced placed;
  placed.epochs = {{0, 0, -1, {}, 0}, {0, 1, 30, Sim3{2, kPose}, 0}};
  placed.T_odom_map = {2, SE3()};
  placed.T_world_odom = T_world_odom;
  return placed;
}

TEST(LiveFrames, VehicleMovesAsTheCamera) {
  LiveFrames frames(kMount, true);
  frames.set_metres_per_unit(3, 0);
  Eigen::Matrix4d in_metres = kPose.matrix();
  in_metres.topRightCorner<3, 1>() *= 3;
  const Eigen::Matrix4d want = kMount.matrix() * in_metres * kMount.matrix().inverse();
  EXPECT_TRUE(frames.T_odom_base(kPose).matrix().isApprox(want, 1e-12));
  EXPECT_TRUE(frames.T_odom_base(SE3()).matrix().isApprox(Eigen::Matrix4d::Identity(), 1e-12));
}

TEST(LiveFrames, WithoutMetresTheLeverArmIsIgnored) {
  const LiveFrames frames(kMount, false);
  EXPECT_EQ(frames.T_base_cam().translation(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(frames.T_base_cam().R().isApprox(kMount.R(), 1e-12));
}

TEST(LiveFrames, ANewUnitMovesNothing) {
  LiveFrames frames(kMount, true);
  frames.set_metres_per_unit(3, 0);
  frames.note_pose(kPose);
  const SE3 before = frames.T_odom_base(kPose);
  frames.set_metres_per_unit(4, 0);
  EXPECT_LT((before.inverse() * frames.T_odom_base(kPose)).log().norm(), 1e-12);
  const SE3 farther(kPose.rotation(), kPose.translation() + Eigen::Vector3d(1, 0, 0));
  EXPECT_NEAR((frames.T_odom_base(farther).translation() - before.translation()).norm(), 4, 1e-12);
  EXPECT_EQ(frames.changes(), 0);
}

TEST(LiveFrames, MapToOdomIsRigidAndCounted) {
  LiveFrames frames(kMount, true);
  frames.set_metres_per_unit(3, 0);
  EXPECT_LT(frames.T_map_odom().log().norm(), 1e-12);
  frames.follow(placed_at(kPose));
  EXPECT_EQ(frames.changes(), 1);
  Eigen::Matrix4d in_metres = kPose.matrix();
  in_metres.topRightCorner<3, 1>() *= 3;
  EXPECT_TRUE(
      frames.T_map_odom().matrix().isApprox(kMount.matrix() * in_metres * kMount.matrix().inverse(), 1e-12));
  EXPECT_EQ(frames.metres_per_map_unit(0), 6);
}

// A place in the world is one, whether it is reached by live poses or by the epoch of a keyframe.
TEST(LiveFrames, KeyframesLieInTheMap) {
  LiveFrames frames(kMount, true);
  frames.set_metres_per_unit(3, 0);
  frames.note_pose(SE3(Eigen::Quaterniond::Identity(), {1, 2, 3}));
  frames.set_metres_per_unit(4, 0);
  EpochsPlaced placed = placed_at(kPose);
  placed.T_world_odom = (placed.epochs[1].T_world_map * placed.T_odom_map.inverse()).rigid;
  frames.follow(placed);
  const SE3 T_segment_cam = kPose;
  const SE3 T_odom_cam = placed.T_odom_map.apply(T_segment_cam);
  const SE3 by_poses = frames.T_map_odom() * frames.T_odom_base(T_odom_cam) * frames.T_base_cam();
  const SE3 by_epoch = frames.T_map_segment(0, 35).apply(T_segment_cam);
  EXPECT_LT((by_poses.inverse() * by_epoch).log().norm(), 1e-9);
  EXPECT_NEAR(frames.T_map_segment(0, 35).scale, 8, 1e-12);
  EXPECT_NEAR(frames.T_map_segment(0, 10).scale, 4, 1e-12);
}

// Columns of the covariance's factor are small motions: each is made, and its effect compared.
TEST(LiveFrames, CovarianceIsThatOfSmallMotions) {
  const double small = 1e-6, length = 2.5;
  const SE3 T_odom_cam(kPose);
  const auto base = [&](const SE3& T) { return kMount * T * kMount.inverse(); };
  Matrix6d J;
  for (int i = 0; i < 6; ++i) {
    Vector6d xi = Vector6d::Unit(i) * small;
    xi.head<3>() *= length;
    // T_cam_ref <- exp(xi) T_cam_ref turns T_odom_cam into T_odom_cam exp(-xi).
    const SE3 moved = base(T_odom_cam * SE3::exp(-xi)), still = base(T_odom_cam);
    J.col(i).head<3>() = (moved.translation() - still.translation()) / small;
    J.col(i).tail<3>() =
        SE3(Eigen::Quaterniond(moved.R() * still.R().transpose()), {0, 0, 0}).log().tail<3>() / small;
  }
  const Matrix6d A = Matrix6d::Random();
  const Matrix6d covariance = A * A.transpose();
  const Matrix6d got = in_parent(body_covariance(covariance, length, kMount), base(T_odom_cam));
  EXPECT_TRUE(got.isApprox(J * covariance * J.transpose(), 1e-4));
}

}  // namespace
}  // namespace edgevo
