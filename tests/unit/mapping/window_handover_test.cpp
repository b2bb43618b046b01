// SPDX-License-Identifier: BSD-3-Clause
// Points that outlive their host: what they keep, and what becomes of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "window_scene.h"

namespace edgevo {
namespace {

using test::kFramesApart;
using test::OwnWindow;
using test::seven_keyframes;
using test::Sweep;
using test::tracking_covariance;
using test::true_window;

void add_and_match(int id, OwnWindow* window) {
  Random random(3);
  window->add(test::true_keyframe(id, id * kFramesApart, 0.0, &random));
  window->newest().immature.clear();
  window->associate_newest(tracking_covariance());
}

// Six keyframes that see the points of the first one, which has left.
OwnWindow window_after_removal(const WindowParams& params = seven_keyframes()) {
  OwnWindow window = true_window(3, 0.02, params);
  for (Keyframe& k : window.keyframes())
    if (k.id > 0) k.immature.clear();
  window.activate({2, 2});
  for (int id = 3; id < 7; ++id) add_and_match(id, &window);
  window.adjust();
  window.remove_oldest();
  return window;
}

std::vector<MapPoint> passed_on(const Window& window) {
  std::vector<MapPoint> points;
  for (const MapPoint& p : window.newest().points)
    if (p.known_sigma > 0) points.push_back(p);
  return points;
}

TEST(PointsPassedOn, BelongToTheNewestKeyframeAndKeepTheirDepth) {
  const OwnWindow window = window_after_removal();
  const std::vector<MapPoint> points = passed_on(window);
  ASSERT_GT(points.size(), 20u);
  std::vector<double> off;
  for (const MapPoint& p : points) {
    EXPECT_TRUE(p.observations.empty()) << "its matches are in the prior";
    EXPECT_EQ(p.idepth, p.known_idepth);
    EXPECT_GT(p.known_sigma, p.idepth_sigma) << "the prior has the same matches";
    const EdgePixel& edge = window.newest().pyramid->finest().edges.pixels[size_t(p.edge_pixel)];
    EXPECT_LT((edge.position().cast<double>() - p.px).norm(), 3) << "matched patches need not lie on edges";
    off.push_back(std::abs(p.idepth / Sweep::idepth(window.newest().frame_index, p.px) - 1));
  }
  EXPECT_LT(median(off), 0.02);
}

TEST(PointsPassedOn, AreNotThereWhereTheKeyframeHasPointsOfItsOwn) {
  const OwnWindow window = window_after_removal();
  const std::vector<MapPoint>& points = window.newest().points;
  std::vector<int> pixels;
  for (const MapPoint& p : points) pixels.push_back(p.edge_pixel);
  std::sort(pixels.begin(), pixels.end());
  EXPECT_EQ(std::adjacent_find(pixels.begin(), pixels.end()), pixels.end());
}

TEST(PointsPassedOn, StayIfTheNextKeyframeMatchesThem) {
  OwnWindow window = window_after_removal();
  const size_t before = passed_on(window).size();
  add_and_match(7, &window);
  window.adjust();
  size_t stayed = 0;
  for (const Keyframe& k : window.keyframes())
    for (const MapPoint& p : k.points) {
      EXPECT_FALSE(p.observations.empty());
      stayed += p.known_sigma > 0;
    }
  EXPECT_GT(stayed, before / 2);
}

TEST(PointsPassedOn, AreGoneIfTheNextKeyframeDoesNotMatchThem) {
  OwnWindow window = window_after_removal();
  ASSERT_FALSE(passed_on(window).empty());
  window.adjust();
  for (const Keyframe& k : window.keyframes())
    for (const MapPoint& p : k.points) EXPECT_EQ(p.known_sigma, 0);
}

// Matches show no unit of length: the depths that are known do.
TEST(PointsPassedOn, CarryTheUnitThroughAnAdjustment) {
  const auto unit_after = [](bool with_known) {
    OwnWindow window = window_after_removal();
    add_and_match(7, &window);
    constexpr double kWrong = 1.1;  // lengths of the window over true ones
    const Keyframe& host = window.keyframes()[window.keyframes().size() - 2];
    const SE3 T_host_world = host.T_cam_world;
    for (Keyframe& k : window.keyframes()) {
      const SE3 T = k.T_cam_world * T_host_world.inverse();
      k.T_cam_world = SE3(T.rotation(), kWrong * T.translation()) * T_host_world;
      for (MapPoint& p : k.points) {
        p.idepth /= kWrong;
        if (!with_known) p.known_sigma = 0;
      }
    }
    // Only the pose of their host is known, to a millionth.
    BaPrior known;
    known.pose_ids = {host.id};
    known.linearization = {T_host_world};
    known.H = 1e12 * Eigen::MatrixXd::Identity(6, 6);
    known.b = Eigen::VectorXd::Zero(6);
    window.set_prior(known);
    for (int i = 0; i < 5; ++i) window.adjust();
    const double true_length =
        (test::sweep_pose(7 * kFramesApart).translation() - test::sweep_pose(6 * kFramesApart).translation())
            .norm();
    return relative_pose(window.newest(), host).translation().norm() / true_length;
  };
  EXPECT_NEAR(unit_after(true), 1, 0.04);
  EXPECT_GT(unit_after(false), 1.05);
}

// They are far ones, which stay in view for long; nearer ones must come in, too.
TEST(PointsPassedOn, KeepNoNewPointsOut) {
  OwnWindow window = window_after_removal();
  add_and_match(7, &window);
  Keyframe& host = window.keyframes()[window.keyframes().size() - 2];  // they were passed on to it
  const std::vector<MapPoint> all = host.points;
  int candidates = 0;
  for (const MapPoint& p : all) {
    if (!(p.known_sigma > 0) || p.observations.empty()) continue;
    for (int copy = 0; copy < 3; ++copy) host.points.push_back(p);  // more than a cell may have
    ImmaturePoint near;
    near.px = p.px;
    near.normal = p.normal;
    near.edge_pixel = p.edge_pixel;
    near.idepth = p.idepth;
    near.idepth_sigma = p.idepth_sigma;
    near.good = 2;
    host.immature.push_back(near);
    ++candidates;
  }
  ASSERT_GT(candidates, 10);
  EXPECT_GT(window.activate({2, 1}), candidates / 4);
}

TEST(PointsPassedOn, CanBeSwitchedOff) {
  WindowParams params = seven_keyframes();
  params.pass_on_points = false;
  EXPECT_TRUE(passed_on(window_after_removal(params)).empty());
}

TEST(PointsPassedOn, FollowTheUnitOfAMovedMap) {
  OwnWindow window = window_after_removal();
  const std::vector<MapPoint> before = passed_on(window);
  MapMoved moved;
  moved.segment = 0;
  moved.prior.emplace();
  for (const Keyframe& k : window.keyframes()) {
    const SE3 T = k.T_cam_world * window.newest().T_cam_world.inverse();
    moved.keyframes.push_back({k.id, SE3(T.rotation(), 2 * T.translation()), 2, {}, ImageMotion()});
  }
  window.map->move(moved, [](const Keyframe& k) { return k.pyramid; });
  const std::vector<MapPoint> after = passed_on(window);
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < after.size(); ++i) {
    EXPECT_DOUBLE_EQ(after[i].known_idepth, before[i].known_idepth / 2);
    EXPECT_DOUBLE_EQ(after[i].known_sigma, before[i].known_sigma / 2);
  }
}

}  // namespace
}  // namespace edgevo
