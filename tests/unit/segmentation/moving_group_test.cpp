// SPDX-License-Identifier: BSD-3-Clause
#include "moving_group.h"

#include <gtest/gtest.h>

#include "support/pasted_body.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::BodyPlace;
using test::twist;

const BodyPlace kGroupPlace{120, 80, 70};

BodyPlace scaled(const BodyPlace& body, double by) {
  return {body.left + 0.5 * (1 - by) * body.width, body.top + 0.5 * (1 - by) * body.width, by * body.width};
}

// Edge pixels of an image inside the body.
std::vector<OrientedPixel> pixels_of(const FramePyramid& pyramid, const BodyPlace& body) {
  std::vector<OrientedPixel> pixels;
  for (const EdgePixel& e : pyramid.finest().edges.pixels)
    if (e.x > body.left && e.y > body.top && e.x < body.left + body.width && e.y < body.top + body.width)
      pixels.push_back({e.position().cast<double>(), e.normal()});
  return pixels;
}

class GroupsThatMove : public ::testing::Test {
 protected:
  GroupMotion follow(const BodyPlace& to) const {
    const auto before = views.pyramid(SE3(), kGroupPlace), now = views.pyramid(SE3(), to);
    const Eigen::Vector2d centre(kGroupPlace.left + 0.5 * kGroupPlace.width,
                                 kGroupPlace.top + 0.5 * kGroupPlace.width);
    return align_group(*now, pixels_of(*before, kGroupPlace), {{centre, Eigen::Vector2d::Zero(), 1.0}});
  }
  MovingGroup find(const BodyPlace& to, const SE3& T_cur_ref = SE3()) const {
    return find_moving_group(*views.pyramid(T_cur_ref.inverse(), to), views.cloud(SE3(), kGroupPlace),
                             T_cur_ref, AlignmentParams());
  }
  test::SceneWithBody views;
};

TEST_F(GroupsThatMove, ShiftAndChangeOfSizeOfAGroupAreFound) {
  const GroupMotion shifted = follow({kGroupPlace.left + 3, kGroupPlace.top - 2, kGroupPlace.width});
  EXPECT_NEAR(shifted.motion.shift.x(), 3, 0.2);
  EXPECT_NEAR(shifted.motion.shift.y(), -2, 0.2);
  EXPECT_NEAR(shifted.motion.scale, 1, 0.01);
  EXPECT_GT(shifted.share, 0.8);
  EXPECT_LT(shifted.chance, 0.4);
  const GroupMotion grown = follow(scaled(kGroupPlace, 1.08));
  EXPECT_NEAR(grown.motion.scale, 1.08, 0.01);
  EXPECT_LT(grown.motion.shift.norm(), 0.5);
}

TEST_F(GroupsThatMove, OneMotionAfterAnother) {
  const ImageSimilarity first{{10, 20}, {3, -1}, 1.2}, second{{-5, 7}, {0, 4}, 0.7};
  const ImageSimilarity both = then(first, second);
  for (const Eigen::Vector2d& px : {Eigen::Vector2d(0, 0), {31, -8}})
    EXPECT_LT((both(px) - second(first(px))).norm(), 1e-9);
}

TEST_F(GroupsThatMove, AGroupThatMovesByItselfIsFoundWithAllItsPoints) {
  const MovingGroup group = find({kGroupPlace.left + 6, kGroupPlace.top, kGroupPlace.width});
  ASSERT_FALSE(group.points.empty());
  const ReferenceCloud cloud = views.cloud(SE3(), kGroupPlace);
  int on_body = 0, all = 0;
  const auto is_on_body = [](const Eigen::Vector2f& px) {
    return px.x() > kGroupPlace.left && px.x() < kGroupPlace.left + kGroupPlace.width &&
           px.y() > kGroupPlace.top && px.y() < kGroupPlace.top + kGroupPlace.width;
  };
  for (const CloudPoint& p : cloud.points) all += is_on_body(p.px);
  for (int i : group.points) on_body += is_on_body(cloud.points[size_t(i)].px);
  EXPECT_GT(on_body, 0.8 * all);
  EXPECT_NEAR(group.motion.motion.shift.x(), 6, 0.5);
}

TEST_F(GroupsThatMove, NothingIsFoundWhereNothingMoves) { EXPECT_TRUE(find(kGroupPlace).points.empty()); }

// A vehicle ahead, or a depth that the map has wrong: each moves as something that stands still can move.
TEST_F(GroupsThatMove, AGroupAtAnotherDepthIsFoundWhereDepthsShow) {
  const double fx = views.scene.camera.pinhole().fx;
  const auto find_at = [&](double step, double times_as_far) {
    const SE3 T_cur_ref = SE3::exp(twist(step, 0, 0, 0, 0, 0));
    const double by_map = fx * step * views.scene.idepth(SE3(), {155, 115});
    return find({kGroupPlace.left + times_as_far * by_map, kGroupPlace.top, kGroupPlace.width}, T_cur_ref);
  };
  EXPECT_FALSE(find_at(0.15, 1.5).points.empty());
  EXPECT_TRUE(find_at(0.15, 1).points.empty()) << "where the map has it";
  EXPECT_TRUE(find_at(0.15, 1.2).points.empty()) << "an ordinary error of depth";
  EXPECT_TRUE(find_at(0.03, 2.5).points.empty()) << "the camera has hardly moved";
  EXPECT_FALSE(find_at(0.15, -1).points.empty()) << "nothing that stands still moves so";
}

TEST_F(GroupsThatMove, WhatStandsStillIsComparedOverAllDepths) {
  const auto pixels = pixels_of(*views.pyramid(SE3(), kGroupPlace), kGroupPlace);
  const Pinhole camera = views.scene.camera.pinhole();
  const SE3 ahead = SE3::exp(twist(0, 0, -0.2, 0, 0, 0));  // the camera moves forwards
  const Eigen::Vector2d focus(camera.cx, camera.cy);
  const auto compare = [&](double scale) {
    return compare_with_static(camera, ahead, 0.5, pixels, {focus, Eigen::Vector2d::Zero(), scale});
  };
  EXPECT_LT(compare(1.1).distance_px, 0.1) << "nearer: it grows";
  EXPECT_GT(compare(0.9).distance_px, 2) << "nothing that stands still shrinks";
  EXPECT_TRUE(compare(1.0).is_fixed);
  EXPECT_GT(compare(1.0).parallax_px, 1);
}

}  // namespace
}  // namespace edgevo
