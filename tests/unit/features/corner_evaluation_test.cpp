// SPDX-License-Identifier: BSD-3-Clause
#include "corner_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/corner_street.h"

namespace edgevo {
namespace {

using Street = test::CornerStreet;
const Pinhole& kCamera = test::street_camera();
constexpr auto drive = test::street_drive;

SE3 scaled(const SE3& T, double s) { return {T.rotation(), s * T.translation()}; }

using Motion = std::function<SE3(int)>;
// Evidence of each frame, where the odometry reports `odometry` while the camera moves by `truth`.
std::vector<CornerEvidence> evaluate(Street street, int frames, const Motion& truth, const Motion& odometry) {
  CornerEvaluation evaluation;
  std::vector<CornerEvidence> found;
  SE3 T_cam_world;
  evaluation.add(street.look(T_cam_world, 0), std::nullopt);
  evaluation.begin_map(0.1);
  for (int i = 1; i < frames; ++i) {
    T_cam_world = truth(i) * T_cam_world;
    found.push_back(evaluation.add(street.look(T_cam_world, i), odometry(i)).value());
  }
  return found;
}

// The unit falls by 0.7 within twelve frames, from frame 90 on.
SE3 shrinking(int frame) {
  return scaled(drive(frame), std::pow(0.7, std::clamp((frame - 90) / 12.0, 0.0, 1.0)));
}

bool speaks_of_scale(const CornerEvidence& e) {
  return std::abs(e.change_10) > std::max(0.15, 3 * e.change_10_sigma);
}

TEST(CornerEvaluation, AnHonestOdometryStaysWithinThreeSigmas) {
  const auto found = evaluate(Street(), 150, drive, drive);
  for (size_t i = 70; i < found.size(); ++i) {
    EXPECT_LT(std::abs(found[i].change_10), 3 * found[i].change_10_sigma) << i;
    EXPECT_LT(found[i].change_10_sigma, 0.15) << i;
    EXPECT_LT(found[i].motion_error, 3 * found[i].motion_sigma) << i;
    EXPECT_LT(found[i].motion_error, 0.1) << i;
    EXPECT_GT(found[i].agreeing_share, 0.95) << i;
    EXPECT_LT(found[i].rotation_deg, 0.5) << i;
  }
}

TEST(CornerEvaluation, AUnitThatFallsBy07WithinTwelveFramesIsSeenWithinTenMore) {
  const auto found = evaluate(Street(), 150, drive, shrinking);
  for (size_t i = 0; i < 88; ++i) EXPECT_FALSE(speaks_of_scale(found[i])) << i;
  const CornerEvidence& e = found[90 + 12 + 10 - 1];
  EXPECT_TRUE(speaks_of_scale(e)) << e.change_10 << " +- " << e.change_10_sigma;
  EXPECT_NEAR(e.change_10, -std::log(0.7), 0.12);
  EXPECT_GT(e.motion_error, 0.2);
  EXPECT_LT(e.motion_error, 0.45) << "of the length that fell";
  EXPECT_GT(e.agreeing_share, 0.95) << "no epipolar constraint shows a length";
}

TEST(CornerEvaluation, ASecondMotionOfAFifthOfTheCornersDoesNotMislead) {
  const auto honest = evaluate(Street(0.2), 150, drive, drive);
  for (size_t i = 70; i < honest.size(); ++i) EXPECT_FALSE(speaks_of_scale(honest[i])) << i;
  EXPECT_TRUE(speaks_of_scale(evaluate(Street(0.2), 150, drive, shrinking)[111]));
}

TEST(CornerEvaluation, ARotationLeavesTheLengthUnknown) {
  const auto turn = [](int) {
    Vector6d xi = Vector6d::Zero();
    xi[4] = 0.01;
    return SE3::exp(xi);
  };
  // What the odometry takes for motion is not contradicted, for nobody can see it.
  const auto believed = [&](int i) { return SE3(turn(i).rotation(), Eigen::Vector3d(0, 0, 1e-3)); };
  for (const CornerEvidence& e : evaluate(Street(), 80, turn, believed)) {
    EXPECT_FALSE(speaks_of_scale(e));
    EXPECT_FALSE(e.change_10_sigma < 0.3);
  }
}

TEST(CornerEvaluation, AWrongRotationAndAWrongDirectionShow) {
  const auto turned = [](int i) {
    Vector6d xi = Vector6d::Zero();
    if (i > 60) xi[4] = 0.008;
    return SE3::exp(xi) * drive(i);
  };
  const auto found = evaluate(Street(), 90, drive, turned);
  EXPECT_LT(found[55].rotation_deg, 0.5);
  EXPECT_NEAR(found[80].rotation_deg, 10 * 0.008 * 180 / M_PI, 0.5);
  EXPECT_LT(found[80].agreeing_share, 0.5);
  const auto aside = [](int i) {
    const Eigen::Vector3d t = drive(i).translation();
    return SE3(drive(i).rotation(), i > 60 ? Eigen::Vector3d(-t.z(), 0, t.z()) : t);
  };
  const auto shifted = evaluate(Street(), 90, drive, aside);
  EXPECT_LT(shifted[55].direction_deg, 3);
  EXPECT_NEAR(shifted[80].direction_deg, 45, 6);
}

TEST(CornerEvaluation, StepsOfAStandingCameraAreContradicted) {
  const auto stops = [](int i) { return i > 80 ? SE3() : drive(i); };
  const auto found = evaluate(Street(), 100, stops, drive);
  EXPECT_GT(found[94].motion_error, 0.9);
  EXPECT_LT(found[94].motion_sigma, 0.2);
}

TEST(CornerEvaluation, ANewMapHasANewUnitAndTheCornersKeepTheirs) {
  Street street;
  CornerEvaluation evaluation;
  SE3 T_cam_world;
  evaluation.add(street.look(T_cam_world, 0), std::nullopt);
  evaluation.begin_map(0.1);
  std::optional<CornerEvidence> e;
  for (int i = 1; i < 200; ++i) {
    T_cam_world = drive(i) * T_cam_world;
    const bool is_lost = i >= 100 && i < 104;
    e = evaluation.add(street.look(T_cam_world, i),
                       is_lost ? std::nullopt : std::optional<SE3>(scaled(drive(i), i < 100 ? 1 : 3)));
    EXPECT_EQ(e.has_value(), !is_lost);
    if (i == 103) evaluation.begin_map(0.3);
    if (e) {
      EXPECT_FALSE(speaks_of_scale(*e)) << i;
    }
  }
  EXPECT_NEAR(e->scale, -std::log(3), 0.2);
}

TEST(CornerEvaluation, FewCornersSayNothing) {
  const Eigen::Vector2f still = Eigen::Vector2f::Zero();
  const std::vector<CornerTrack> two{{1, {300, 90}, still}, {2, {310, 94}, still}};
  CornerEvaluation evaluation;
  evaluation.add({kCamera, {}}, std::nullopt);
  evaluation.begin_map(0.1);
  for (int i = 0; i < 100; ++i) {
    const CornerEvidence e = evaluation.add({kCamera, two}, drive(i)).value();
    EXPECT_TRUE(std::isnan(e.change_10) && std::isnan(e.agreeing_share) && std::isnan(e.motion_error));
  }
}

}  // namespace
}  // namespace edgevo
