// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/segment_join.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

using Method = SegmentPlaced::Method;
using Eigen::Vector3d;

// Orientation of the camera before the join.
const Eigen::Quaterniond kHeading(Eigen::AngleAxisd(0.3, Vector3d::UnitY()));

// Poses a tenth of a second apart that move by `step`, the last of them at 1 s.
std::vector<TimedPose> moving(const Vector3d& step, int poses = int(kJoinPoses)) {
  std::vector<TimedPose> previous;
  for (int i = 0; i < poses; ++i)
    previous.push_back({Timestamp::from_seconds(1 + 0.1 * (i + 1 - poses)), SE3(kHeading, double(i) * step)});
  return previous;
}

// Two views, the first at `begin` seconds and the last half a second after it, `length` further on.
MapBeginning bootstrap(double begin, double length) {
  return {Timestamp::from_seconds(begin), Timestamp::from_seconds(begin + 0.5),
          SE3(Eigen::Quaterniond::Identity(), Vector3d(0, 0, -length))};
}

TEST(SegmentJoin, TheFirstSegmentLiesAtTheOrigin) {
  const SegmentPlaced join = join_segment(3, {}, {}, bootstrap(1, 1), std::nullopt);
  EXPECT_EQ(join.segment, 3);
  EXPECT_EQ(join.method, Method::kOrigin);
  EXPECT_EQ(join.T_world_map.scale, 1);
  EXPECT_LT(join.T_world_map.rigid.log().norm(), 1e-12);
}

TEST(SegmentJoin, OnePoseHasNoVelocity) {
  EXPECT_EQ(join_segment(3, moving({0, 0, 1}, 1), {}, bootstrap(1.2, 1), 2.0).method, Method::kOrigin);
}

// 2 units per second before the join, and 2 * 3 units per second in the bootstrap.
TEST(SegmentJoin, ContinuesAtConstantVelocityAndEqualSpeed) {
  const std::vector<TimedPose> previous = moving({0.2, 0, 0});
  const SegmentPlaced join = join_segment(3, previous, {}, bootstrap(1.3, 3), std::nullopt);
  EXPECT_EQ(join.method, Method::kVelocity);
  const Vector3d expected = previous.back().T_world_cam.translation() + 0.3 * Vector3d(2, 0, 0);
  EXPECT_LT((join.T_world_map.rigid.translation() - expected).norm(), 1e-9);
  EXPECT_LT(join.T_world_map.rigid.rotation().angularDistance(kHeading), 1e-9);
  EXPECT_NEAR(join.T_world_map.scale, 2.0 / 6.0, 1e-9);
}

TEST(SegmentJoin, AMeasuredTurnIsThatOfTheJoin) {
  const std::vector<TimedPose> previous = moving({0.2, 0, 0});
  MapBeginning beginning = bootstrap(1.3, 3);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5, Vector3d::UnitY()));
  beginning.turn = {turn, 0.01};
  const SegmentPlaced join = join_segment(3, previous, {}, beginning, std::nullopt);
  EXPECT_LT((join.T_world_map.rigid.rotation() * turn).angularDistance(kHeading), 1e-9);
  EXPECT_EQ(join.rotation_sigma, 0.01);
  EXPECT_NEAR(join.T_world_map.scale, 2.0 / 6.0, 1e-9);
}

TEST(SegmentJoin, AGivenScaleIsUsed) {
  const SegmentPlaced given = join_segment(3, moving({0.2, 0, 0}), {}, bootstrap(1.3, 3), 5.0);
  const SegmentPlaced guessed = join_segment(3, moving({0.2, 0, 0}), {}, bootstrap(1.3, 3), std::nullopt);
  EXPECT_EQ(given.method, Method::kDepthRatio);
  EXPECT_EQ(given.T_world_map.scale, 5);
  EXPECT_EQ(given.T_world_map.rigid.translation(), guessed.T_world_map.rigid.translation());
}

TEST(SegmentJoin, ACameraAtAStandstillGivesNoScale) {
  const std::vector<TimedPose> still = moving(Vector3d::Zero());
  EXPECT_EQ(join_segment(3, still, {}, bootstrap(1.3, 3), std::nullopt).method, Method::kStandstill);
  EXPECT_EQ(join_segment(3, still, {}, bootstrap(1.3, 3), std::nullopt).T_world_map.scale, 1);
  EXPECT_EQ(join_segment(3, moving({0.2, 0, 0}), {}, bootstrap(1.3, 0), std::nullopt).method,
            Method::kStandstill);
}

// The unit is lost before the map is: the last steps are a tenth of those that were sure.
TEST(SegmentJoin, TheScaleIsTheLastThatWasSure) {
  const std::vector<TimedPose> sure = moving({0.2, 0, 0}), shrunk = moving({0, 0.02, 0});
  const SegmentPlaced join = join_segment(3, shrunk, sure, bootstrap(1.3, 3), std::nullopt);
  EXPECT_EQ(join.method, Method::kVelocity);
  EXPECT_NEAR(join.T_world_map.scale, 2.0 / 6.0, 1e-9);
  const Vector3d expected = shrunk.back().T_world_cam.translation() + 0.3 * Vector3d(0, 2, 0);
  EXPECT_LT((join.T_world_map.rigid.translation() - expected).norm(), 1e-9);
}

TEST(SegmentJoin, AGuessOfTheScaleSaysHowFarItIsOne) {
  EXPECT_EQ(join_segment(3, {}, {}, bootstrap(1, 1), std::nullopt).scale_sigma, 0);
  const double by_speed =
      join_segment(3, moving({0.2, 0, 0}), {}, bootstrap(1.3, 3), std::nullopt).scale_sigma;
  const double by_depths = join_segment(3, moving({0.2, 0, 0}), {}, bootstrap(1.3, 3), 5.0).scale_sigma;
  const double standing =
      join_segment(3, moving(Vector3d::Zero()), {}, bootstrap(1.3, 3), std::nullopt).scale_sigma;
  EXPECT_LT(0, by_depths);
  EXPECT_LT(by_depths, by_speed);
  EXPECT_LT(by_speed, standing);
}

// What both maps see places the new one, whatever the camera has done in between: a point of the scene has
// one position in the world.
TEST(SegmentJoin, AViewOfBothMapsPlacesTheNewOne) {
  Reference before, after;
  before.T_ref_world = SE3(kHeading, Vector3d(1, 2, 3));
  after.T_ref_world = SE3(Eigen::Quaterniond::Identity(), Vector3d(0, 0, -4));
  const Sim3 T_world_before{2, SE3(kHeading, Vector3d(-5, 0, 1))};
  SegmentLink link;
  link.T_b_a = SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vector3d::UnitX())), Vector3d(0.1, 0, -2));
  link.scale = 0.25, link.sigma = 0.03;
  const SegmentPlaced join = link_segment(4, before, T_world_before, after, link);
  EXPECT_EQ(join.method, Method::kLinked);
  EXPECT_EQ(join.scale_sigma, 0.03);
  const Vector3d in_view_before(1, -0.5, 8);
  const Vector3d in_view_after = (link.T_b_a * in_view_before) / link.scale;
  const Vector3d a = T_world_before * (before.T_ref_world.inverse() * in_view_before),
                 b = join.T_world_map * (after.T_ref_world.inverse() * in_view_after);
  EXPECT_LT((a - b).norm(), 1e-9);
}

}  // namespace
}  // namespace edgevo
