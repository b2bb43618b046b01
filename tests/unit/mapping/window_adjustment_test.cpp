// SPDX-License-Identifier: BSD-3-Clause
// The adjustment of the window: it recovers perturbed poses and depths, and drops what does not fit.
#include "edgevo/mapping/window.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "window_scene.h"

namespace edgevo {
namespace {

using test::idepth_error;
using test::OwnWindow;
using test::pose_error;
using test::seven_keyframes;
using test::Sweep;
using test::true_window;

TEST(Window, RecoversDepths) {
  OwnWindow window = true_window(5, 0.04);
  window.activate({2, 2});
  const double before = idepth_error(window);
  const WindowStats stats = window.adjust();
  EXPECT_GT(stats.points, 200);
  EXPECT_GT(before, 0.02);
  // A match is good to about 0.3 px, and the points move by about 20 px over the window.
  EXPECT_LT(idepth_error(window), 0.3 / 20);
}

TEST(Window, RecoversPosesAndDepths) {
  OwnWindow window = true_window(6, 0.02);
  window.activate({2, 2});
  Random random(8);
  // Keyframes 0 and 1 fix the gauge. A hundredth of the depth is about 0.3 px at this focal length.
  for (size_t k = 2; k < window.keyframes().size(); ++k) {
    Vector6d xi;
    for (int i = 0; i < 6; ++i) xi[i] = (i < 3 ? 0.03 : 0.004) * random.normal();
    window.keyframes()[k].T_cam_world = SE3::exp(xi) * window.keyframes()[k].T_cam_world;
  }
  WindowStats stats;
  for (int i = 0; i < 3; ++i) stats = window.adjust();
  EXPECT_LT(stats.cost_per_observation, 1);
  for (const Keyframe& k : window.keyframes()) {
    EXPECT_LT(pose_error(k).translation().norm(), k.id < 2 ? 1e-12 : 0.02) << k.id;
    EXPECT_LT(pose_error(k).angle(), k.id < 2 ? 1e-12 : 0.004) << k.id;
  }
  EXPECT_LT(idepth_error(window), 0.01);
}

// The newest keyframe as after a turn in which none of its matches is right: only its corners constrain its
// rotation.
OwnWindow window_that_lost_its_newest(bool with_corners, const WindowParams& params = seven_keyframes()) {
  OwnWindow window = true_window(4, 0.02, params);
  window.activate({2, 2});
  Keyframe& newest = window.newest();
  for (Keyframe& k : window.keyframes())
    for (MapPoint& p : k.points)
      p.observations.erase(std::remove_if(p.observations.begin(), p.observations.end(),
                                          [&](const Observation& o) { return o.keyframe_id == newest.id; }),
                           p.observations.end());
  newest.points.clear();
  const Keyframe& last = window.keyframes()[2];
  if (with_corners) {
    const SE3 T = relative_pose(newest, last);
    newest.corners_from = last.id;
    for (double y = 20; y < 230; y += 20)
      for (double x = 20; x < 310; x += 20) {
        const Eigen::Vector3d ray = Sweep::pinhole().ray({x, y}),
                              there = T * Eigen::Vector3d(ray / Sweep::idepth(last.frame_index, {x, y}));
        newest.corners.push_back({ray, there / there.z()});
      }
  }
  Vector6d wrong = Vector6d::Zero();
  wrong.tail<3>() << 0.02, -0.03, 0.01;
  newest.T_cam_world = SE3::exp(wrong) * newest.T_cam_world;
  window.adjust();
  window.adjust();
  return window;
}

TEST(Window, CornersConstrainAKeyframeThatItsEdgesDoNot) {
  EXPECT_GT(pose_error(window_that_lost_its_newest(false).newest()).angle(), 0.03);
  EXPECT_LT(pose_error(window_that_lost_its_newest(true).newest()).angle(), 0.001);
  WindowParams without = seven_keyframes();
  without.adjust_corners = false;
  EXPECT_GT(pose_error(window_that_lost_its_newest(true, without).newest()).angle(), 0.03);
}

TEST(Window, AdjustingTwiceFromTheSameStartGivesTheSame) {
  const auto run = [] {
    OwnWindow window = true_window(5, 0.04);
    window.activate({2, 2});
    window.adjust();
    std::vector<double> values;
    for (const Keyframe& k : window.keyframes()) {
      for (const MapPoint& p : k.points) values.push_back(p.idepth);
      values.push_back(k.T_cam_world.translation().sum());
    }
    return values;
  };
  EXPECT_EQ(run(), run());
}

// The point of the first keyframe with the most matches, to corrupt.
MapPoint& best_point(const Window& window) {
  const std::vector<MapPoint>& points = window.keyframes().front().points;
  const auto most = std::max_element(points.begin(), points.end(), [](const MapPoint& a, const MapPoint& b) {
    return a.observations.size() < b.observations.size();
  });
  return const_cast<MapPoint&>(*most);
}

// Corrupts one match by 30 pixels and adjusts. Returns whether it is still there.
bool keeps_spoiled_match(WindowParams params) {
  params.ba_update_iterations = 0;  // no match is updated
  OwnWindow window = true_window(5, 0.0, params);
  window.activate({2, 2});
  MapPoint& point = best_point(window);
  EXPECT_GE(point.observations.size(), 3u);
  const Eigen::Vector2d px = point.px;
  const int spoiled = point.observations.front().keyframe_id;
  Match& match = point.observations.front().match;
  match.px += 30.0 * match.normal;
  window.adjust();
  const std::vector<MapPoint>& points = window.keyframes().front().points;
  const auto it = std::find_if(points.begin(), points.end(), [&](const MapPoint& p) { return p.px == px; });
  if (it == points.end()) {
    ADD_FAILURE() << "the point is gone";
    return false;
  }
  EXPECT_GE(it->observations.size(), 2u);
  return it->find(spoiled) != nullptr;
}

TEST(Window, AMatchFarBeyondItsSigmaIsDropped) {
  WindowParams params = seven_keyframes();
  EXPECT_FALSE(keeps_spoiled_match(params));
  params.drop_outlier_matches = false;
  EXPECT_TRUE(keeps_spoiled_match(params));
}

TEST(Window, APointMissedByManyKeyframesIsDropped) {
  const auto dropped = [](const WindowParams& params) {
    OwnWindow window = true_window(5, 0.0, params);
    const int points = window.activate({2, 2});
    best_point(window).misses = 4;
    window.adjust();
    return points - window.active_points();
  };
  WindowParams params = seven_keyframes();
  EXPECT_EQ(dropped(params), 1);
  params.drop_missed_points = false;
  EXPECT_EQ(dropped(params), 0);
}

// Two views show no scale: if all depths started too near, the baseline would follow them.
TEST(Window, TheBootstrapKeepsItsScale) {
  OwnWindow window = true_window(2, 0.04);
  for (Keyframe& k : window.keyframes())
    for (ImmaturePoint& p : k.immature) p.idepth *= 1.08;
  const double before = relative_pose(window.keyframes()[1], window.keyframes()[0]).translation().norm();
  window.fix_bootstrap_scale();
  window.activate({2, 1});
  window.adjust();
  EXPECT_NEAR(relative_pose(window.keyframes()[1], window.keyframes()[0]).translation().norm(), before,
              0.01 * before);
  EXPECT_LT(pose_error(window.keyframes()[0]).log().norm(), 1e-12);
}

TEST(Window, AnEmptyWindowDoesNothing) {
  OwnWindow window = true_window(3, 0.0);
  const WindowStats stats = window.adjust();  // no point is active
  EXPECT_EQ(stats.points, 0);
  EXPECT_EQ(stats.observations, 0);
  for (const Keyframe& k : window.keyframes()) EXPECT_LT(pose_error(k).log().norm(), 1e-9);
  EXPECT_TRUE(window.cloud(window.newest()).empty());
}

}  // namespace
}  // namespace edgevo
