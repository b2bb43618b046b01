// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/stationary_detector.h"

#include <gtest/gtest.h>

#include "support/pasted_body.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

// A camera before a plane, and two images: its keyframe's, and the next one, whose left half may stand still.
class AStandingCamera : public ::testing::Test {
 protected:
  AStandingCamera() {
    reference->cloud = views.cloud(SE3(), {-500, 0, 70});
    frame = views.pyramid(SE3(), {200, 60, 110});
    standstill.follow(moving, SE3(), false);
    standstill.follow(standing, SE3(), true);
  }
  std::shared_ptr<const Reference> still_part(const StillCells& cells, const SE3& T_cur_ref) {
    return standstill.still_part(*frame, cells, reference, T_cur_ref, AlignmentParams());
  }

  test::SceneWithBody views;
  std::shared_ptr<Reference> reference = std::make_shared<Reference>();
  std::shared_ptr<const FramePyramid> frame;
  const StillCells moving = {}, standing = {2, 1, {1, 0}};
  StationaryDetector standstill;
  const SE3 turned = SE3::exp(twist(0, 0, 0, 0, 0.02, 0));  // 5 px
};

TEST_F(AStandingCamera, KeepsItsPoseWhereAnotherOneMovesWhatStandsStill) {
  const auto still = still_part(standing, turned);
  ASSERT_TRUE(still);
  EXPECT_TRUE(standstill.T_standing_ref().translation().isZero());
  EXPECT_FALSE(still->cloud.points.empty());
  for (const CloudPoint& p : still->cloud.points) EXPECT_LT(p.px.x(), 160) << "the right half moves";
}

TEST_F(AStandingCamera, KeepsItsPoseWhereTooMuchOfItsViewIsHidden) {
  EXPECT_TRUE(still_part(standing, SE3()));
}

TEST_F(AStandingCamera, MovesWithAViewThatMoves) {
  EXPECT_FALSE(still_part(moving, turned));
  standstill.follow(moving, turned, false);
  standstill.follow(standing, turned, true);
  EXPECT_FALSE(still_part(standing, turned)) << "it stands where it has moved to";
}

TEST_F(AStandingCamera, IsNotHeldWhereItWasNeverSeenToStand) {
  standstill.follow(moving, SE3(), false);
  standstill.follow(standing, SE3(), false);
  EXPECT_FALSE(still_part(standing, turned)) << "a lorry that it follows stands still in its images, too";
}

TEST_F(AStandingCamera, DoesNotCreepWhileItStands) {
  standstill.follow(standing, turned, true);
  EXPECT_TRUE(still_part(standing, turned));
}

TEST_F(AStandingCamera, IsNotHeldToAPoseThatItsStillPartDoesNotFit) {
  standstill.follow(moving, SE3::exp(twist(0, 0, 0, 0, 0.3, 0)), false);
  standstill.follow(standing, SE3::exp(twist(0, 0, 0, 0, 0.3, 0)), true);
  EXPECT_FALSE(still_part(standing, SE3()));
}

TEST_F(AStandingCamera, IsKnownToStandWhereAUsualStepWouldShow) {
  const auto stands = [&](const StillCells& cells, const SE3& T, double usual) {
    return standstill.stands(cells, frame->finest().pinhole, reference->cloud, T, {usual, 0, 0});
  };
  EXPECT_TRUE(stands(standing, SE3(), 0.5));
  EXPECT_FALSE(stands(standing, SE3(), 1e-3)) << "what stands still is too far away to show it";
  EXPECT_FALSE(stands(standing, turned, 0.5)) << "the pose says that it moves";
  EXPECT_FALSE(stands(moving, SE3(), 0.5)) << "the view says so";
}

TEST_F(AStandingCamera, KeepsItsPoseInAnotherReference) {
  const SE3 T_old_new = SE3::exp(twist(0.2, 0, 0.1, 0, 0, 0));
  standstill.change_reference(T_old_new);
  for (CloudPoint& p : reference->cloud.points) {
    const Eigen::Vector3d Y = T_old_new.inverse() * (p.ray / p.idepth);
    p.ray = Y / Y.z();
    p.idepth = 1 / Y.z();
  }
  EXPECT_TRUE(still_part(standing, turned * T_old_new));
  EXPECT_LT((standstill.T_standing_ref() * T_old_new.inverse()).log().norm(), 1e-9);
}

TEST_F(AStandingCamera, ForgetsItsPose) {
  standstill.clear();
  EXPECT_FALSE(still_part(standing, turned));
}

}  // namespace
}  // namespace edgevo
