// SPDX-License-Identifier: BSD-3-Clause
// Which of several statements about one pose hold.
#include "stated_poses.h"

#include <gtest/gtest.h>

#include "edgevo/core/angle.h"
#include "epoch_constraints.h"

namespace edgevo {
namespace {

const UnknownPose kUnknown{30, 1};
const MistakenViews kSeldom{0.25, 1}, kOften{20, 1};

SE3 turned(double degrees, const Eigen::Vector3d& position) {
  return SE3(Eigen::Quaterniond(Eigen::AngleAxisd(rad(degrees), Eigen::Vector3d::UnitY())), position);
}
StatedPose stated(const SE3& T, double position_sigma, double rotation_sigma) {
  StatedPose s{T, Matrix6d::Zero()};
  s.covariance.diagonal() << Eigen::Vector3d::Constant(position_sigma * position_sigma),
      Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma);
  return s;
}
GuessedPose guess(double rotation_deg) { return {stated(turned(0, {0, 0, 0}), 10, rad(rotation_deg)), 0.05}; }
StatedPose view(double degrees, const Eigen::Vector3d& p) { return stated(turned(degrees, p), 0.5, rad(1)); }

using Holds = std::vector<bool>;
Holds choose(const std::vector<StatedPose>& views, const std::optional<GuessedPose>& guess,
             const MistakenViews& known = kSeldom) {
  return views_that_hold(views, guess, known, kUnknown);
}

TEST(StatedPoses, AViewNearWhatWasGuessedHolds) {
  EXPECT_EQ(choose({view(15, {4, 0, 6})}, guess(10)), (Holds{true}));
}

// A loss of many seconds: hardly anything was guessed.
TEST(StatedPoses, OneViewHoldsWhereTheGuessSaysNothing) {
  const GuessedPose vague{stated(turned(0, {0, 0, 0}), 100, 1), 0.05};
  EXPECT_EQ(choose({view(0, {0, 0, 0})}, vague), (Holds{true}));
  EXPECT_EQ(choose({view(60, {80, 0, 30})}, vague), (Holds{true}));
}

// Round the corner of a block that looks alike.
TEST(StatedPoses, OneViewFarFromWhatWasGuessedIsMistaken) {
  EXPECT_EQ(choose({view(86, {20, 0, 3})}, guess(10)), (Holds{false}));
}

TEST(StatedPoses, TwoViewsThatAgreeRefuteAGuess) {
  EXPECT_EQ(choose({view(86, {20, 0, 3}), view(87, {20.5, 0, 3})}, guess(10)), (Holds{true, true}));
}

// After two seconds without sight a guess says little, but views that contradict each other say less.
TEST(StatedPoses, ViewsThatContradictEachOtherLeaveTheGuess) {
  const StatedPose first = view(82, {25, 0, 10}), second = view(-60, {0, 0, 40}),
                   third = view(170, {-30, 0, 9});
  EXPECT_EQ(choose({first}, guess(43)), (Holds{true}));
  EXPECT_EQ(choose({first, second, third}, guess(43)), (Holds{false, false, false}));
}

TEST(StatedPoses, WhereMistakesAreCommonOneViewIsNotBelieved) {
  EXPECT_EQ(choose({view(60, {15, 0, 8})}, guess(43), kSeldom), (Holds{true}));
  EXPECT_EQ(choose({view(60, {15, 0, 8})}, guess(43), kOften), (Holds{false}));
  EXPECT_EQ(choose({view(60, {15, 0, 8}), view(60, {15, 0, 8})}, guess(43), kOften), (Holds{true, true}));
}

TEST(StatedPoses, WhatCannotFailHolds) {
  const GuessedPose sure{stated(turned(0, {0, 0, 0}), 0.1, rad(0.2)), 0};
  EXPECT_EQ(choose({view(86, {20, 0, 3}), view(86, {20, 0, 3})}, sure), (Holds{false, false}));
  EXPECT_EQ(choose({view(86, {20, 0, 3})}, std::nullopt), (Holds{true}));
  EXPECT_TRUE(choose({}, sure).empty());
}

// Against differences: each constraint turned and moved a little about its centre.
TEST(StatedPoses, UncertainConstraintsInARowAddUp) {
  std::vector<Constraint> constraints(2);
  constraints[0].T_from_to.rigid = turned(30, {1, 2, 3});
  constraints[0].centre = {0.5, 0, -2};
  constraints[1].T_from_to.rigid = turned(-70, {-4, 0, 1});
  constraints[1].centre = {1, 1, 1};
  const SE3 T_last_cam = turned(10, {2, -1, 5});
  const StatedPose pose = state_pose(constraints, T_last_cam);
  Matrix6d expected = Matrix6d::Zero();
  for (size_t i = 0; i < 2; ++i) {
    Vector6d sigmas;
    sigmas << 0.1, 0.2, 0.3, 0.01, 0.02, 0.03;
    constraints[i].covariance = covariance_of(1, 1, 1);
    constraints[i].covariance.topLeftCorner<6, 6>() = sigmas.cwiseAbs2().asDiagonal();
    for (int k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-6;
      Vector6d xi = Vector6d::Zero();
      xi[k] = kStep;
      const SE3 T_centre(Eigen::Quaterniond::Identity(), constraints[i].centre);
      SE3 T = T_last_cam;
      for (size_t j = 2; j-- > 0;) {
        T = constraints[j].T_from_to.rigid * T;
        if (j == i) T = T_centre * SE3::exp(xi) * T_centre.inverse() * T;
      }
      const Eigen::AngleAxisd turn(T.rotation() * pose.T_frame_cam.rotation().conjugate());
      Vector6d moved;
      moved << T.translation() - pose.T_frame_cam.translation(), turn.angle() * turn.axis();
      moved *= sigmas[k] / kStep;
      expected += moved * moved.transpose();
    }
  }
  EXPECT_LT((state_pose(constraints, T_last_cam).covariance - expected).norm(), 1e-4 * expected.norm());
}

}  // namespace
}  // namespace edgevo
