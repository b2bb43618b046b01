// SPDX-License-Identifier: BSD-3-Clause
// The motion hypothesis from corners: how exact it is, and when there is none.
#include "edgevo/features/corner_motion.h"

#include <gtest/gtest.h>

#include "support/sweep_scene.h"

namespace edgevo {
namespace {

using test::Sweep;
using test::sweep_pose;

SE3 true_motion(int from, int to) { return sweep_pose(to).inverse() * sweep_pose(from); }

SE3 turned_by(const Eigen::Vector3d& radians, const SE3& T) {
  Vector6d xi = Vector6d::Zero();
  xi.tail<3>() = radians;
  return SE3::exp(xi) * T;
}

std::optional<CornerMotion> ask(int from, int to, const SE3& guess, const CornerParams& params = {},
                                uint64_t seed = 1) {
  Random random(seed);
  return find_corner_motion(Sweep::pinhole(), *Sweep::pyramid(from), *Sweep::pyramid(to), guess, params,
                            &random);
}

TEST(CornerMotion, IsFoundFromAGuessThatIsDegreesWrong) {
  const SE3 truth = true_motion(0, 12);
  const std::optional<CornerMotion> m = ask(0, 12, turned_by({0.03, -0.05, 0.02}, truth));
  ASSERT_TRUE(m);
  EXPECT_LT((m->T_to_from * truth.inverse()).angle(), 0.003);
  EXPECT_LT((m->T_to_from.translation() - truth.translation().normalized()).norm(), 0.05);
  EXPECT_NEAR(m->T_to_from.translation().norm(), 1, 1e-12);
  EXPECT_GT(m->pairs.size(), 100u);
}

// The rays of a pair are those of one point of the scene.
TEST(CornerMotion, PairsShowTheSamePointInBothImages) {
  const SE3 truth = true_motion(0, 12);
  const std::optional<CornerMotion> m = ask(0, 12, truth);
  ASSERT_TRUE(m);
  std::vector<double> error_px;
  for (const CornerPair& c : m->pairs) {
    const double idepth = Sweep::idepth(0, Sweep::pinhole().project(c.from));
    const Projection p = project(Sweep::pinhole(), truth.R(), truth.translation(), c.from, idepth);
    error_px.push_back((p.px - Sweep::pinhole().project(c.to)).norm());
  }
  ASSERT_FALSE(error_px.empty());
  EXPECT_LT(median(error_px), 0.8);  // slanted walls: their texture is not only shifted
}

TEST(CornerMotion, GivesNoMotionInPureRotation) {
  const SE3 T_world_cam = sweep_pose(0);
  const SE3 turn = turned_by({0, 0.08, 0}, SE3());
  const auto turned = Sweep::scene().pyramid(T_world_cam * turn.inverse(), 1.0, 0.0, 1.0, 99);
  Random random(1);
  EXPECT_FALSE(
      find_corner_motion(Sweep::pinhole(), *Sweep::pyramid(0), *turned, turn, CornerParams(), &random));
}

TEST(CornerMotion, GivesNoMotionWhereFewCornersAgree) {
  const SE3 truth = true_motion(0, 12);
  const auto black = Sweep::scene().pyramid(sweep_pose(12), 0.0, 0.0);
  Random random(1);
  EXPECT_FALSE(
      find_corner_motion(Sweep::pinhole(), *Sweep::pyramid(0), *black, truth, CornerParams(), &random));
  const test::HollowScene other(77);
  EXPECT_FALSE(find_corner_motion(Sweep::pinhole(), *Sweep::pyramid(0), *other.pyramid(sweep_pose(12)), truth,
                                  CornerParams(), &random));
  CornerParams demanding;
  demanding.min_agreeing = 10000;
  EXPECT_FALSE(ask(0, 12, truth, demanding));
}

TEST(CornerMotion, TheSameSeedGivesTheSameBits) {
  const SE3 truth = true_motion(0, 12);
  const auto a = ask(0, 12, truth, {}, 5), b = ask(0, 12, truth, {}, 5);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->T_to_from.matrix(), b->T_to_from.matrix());
  ASSERT_EQ(a->pairs.size(), b->pairs.size());
}

}  // namespace
}  // namespace edgevo
