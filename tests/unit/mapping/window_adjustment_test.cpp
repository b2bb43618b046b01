// The adjustment of the window: perturbed poses and depths come back, what does not fit goes.
#include "edgevo/mapping/window.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "window_scene.h"

namespace edgevo {
namespace {

using test::idepth_error;
using test::pose_error;
using test::seven_keyframes;
using test::Sweep;
using test::true_window;

TEST(Window, RecoversDepths) {
  Window window = true_window(5, 0.04);
  window.activate(2, 2);
  const double before = idepth_error(window);
  const WindowStats stats = window.adjust();
  EXPECT_GT(stats.points, 200);
  EXPECT_GT(before, 0.02);
  // A match is good to about 0.3 px, and the points move by about 20 px over the window.
  EXPECT_LT(idepth_error(window), 0.3 / 20);
}

TEST(Window, RecoversPosesAndDepths) {
  Window window = true_window(6, 0.02);
  window.activate(2, 2);
  Random random(8);
  // Keyframes 0 and 1 hold the gauge. A hundredth of the depth is about 0.3 px at this focal length.
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

// The newest keyframe as after a turn in which no match of it is right: only its corners know how it is
// turned.
Window window_that_lost_its_newest(bool with_corners) {
  Window window = true_window(4, 0.02);
  window.activate(2, 2);
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

TEST(Window, CornersHoldAKeyframeThatItsEdgesDoNot) {
  EXPECT_GT(pose_error(window_that_lost_its_newest(false).newest()).angle(), 0.03);
  EXPECT_LT(pose_error(window_that_lost_its_newest(true).newest()).angle(), 0.001);
}

// A corner stays where the camera took it, whatever is found out about the lens.
TEST(Window, CornersMoveWithTheImagesWhenTheCameraIsCorrected) {
  Window window = true_window(2, 0.02);
  const Eigen::Vector3d from = Sweep::pinhole().ray({300, 20}), to = Sweep::pinhole().ray({15, 220});
  window.newest().corners_from = window.keyframes().front().id;
  window.newest().corners = {{from, to}};
  MapRevision revision;
  revision.now.k1 = 0.05;
  for (const Keyframe& k : window.keyframes()) {
    RevisedKeyframe r;
    r.id = k.id;
    r.T_cam_world = k.T_cam_world;
    r.length_ratio = 1;
    for (const MapPoint& p : k.points) r.points.push_back({p.px, p.idepth});
    revision.keyframes.push_back(r);
  }
  window.apply(revision, [](const Keyframe& k) { return k.pyramid; });
  const auto taken_at = [&](const ImageCorrection& c, const Eigen::Vector3d& ray) {
    return to_file(Sweep::pinhole(), c, ImageMotion(), ray.head<2>());
  };
  const CornerPair& moved = window.newest().corners.front();
  EXPECT_LT((taken_at(revision.now, moved.from) - taken_at(revision.before, from)).norm(), 1e-9);
  EXPECT_LT((taken_at(revision.now, moved.to) - taken_at(revision.before, to)).norm(), 1e-9);
  EXPECT_GT((moved.from - from).norm(), 1e-3);
}

// What is known of the keyframes that have left is linearised at poses of before the correction: it comes
// anew with it.
TEST(Window, ACorrectionBringsItsOwnPrior) {
  Window window = true_window(5, 0.02);
  window.activate(2, 2);
  window.adjust();
  MapRevision revision;
  const int kept = int(window.keyframes().size());
  revision.prior.H =
      1e10 * Eigen::MatrixXd::Identity(6 * kept, 6 * kept);  // a tenth of a millimetre against all matches
  revision.prior.b = Eigen::VectorXd::Zero(6 * kept);
  for (const Keyframe& k : window.keyframes()) {
    // A quarter of a degree, which is three pixels at the border, and all edges say that it is wrong.
    const SE3 turned = SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.004 * k.id, Eigen::Vector3d::UnitY())),
                           Eigen::Vector3d::Zero()) *
                       k.T_cam_world;
    RevisedKeyframe r;
    r.id = k.id;
    r.T_cam_world = turned;
    r.length_ratio = 1;
    for (const MapPoint& p : k.points) r.points.push_back({p.px, p.idepth});
    revision.keyframes.push_back(r);
    revision.prior.pose_ids.push_back(k.id);
    revision.prior.linearization.push_back(turned);
  }
  window.apply(revision, [](const Keyframe& k) { return k.pyramid; });
  window.adjust();
  for (size_t i = 0; i < window.keyframes().size(); ++i)
    EXPECT_LT((window.keyframes()[i].T_cam_world * revision.prior.linearization[i].inverse()).log().norm(),
              1e-4)
        << i;
}

TEST(Window, AdjustingTwiceFromTheSameStartGivesTheSame) {
  const auto run = [] {
    Window window = true_window(5, 0.04);
    window.activate(2, 2);
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

// The point of the first keyframe with the most matches, to spoil.
MapPoint& best_point(const Window& window) {
  const std::vector<MapPoint>& points = window.keyframes().front().points;
  const auto most = std::max_element(points.begin(), points.end(), [](const MapPoint& a, const MapPoint& b) {
    return a.observations.size() < b.observations.size();
  });
  return const_cast<MapPoint&>(*most);
}

TEST(Window, AMatchFarBeyondItsDeviationIsDropped) {
  WindowParams params = seven_keyframes();
  params.ba_update_iterations = 0;  // nothing is matched anew
  Window window = true_window(5, 0.0, params);
  window.activate(2, 2);
  MapPoint& point = best_point(window);
  ASSERT_GE(point.observations.size(), 3u);
  const Eigen::Vector2d px = point.px;
  const int spoiled = point.observations.front().keyframe_id;
  Match& match = point.observations.front().match;
  match.px += 30.0 * match.normal;
  window.adjust();
  const std::vector<MapPoint>& points = window.keyframes().front().points;
  const auto it = std::find_if(points.begin(), points.end(), [&](const MapPoint& p) { return p.px == px; });
  ASSERT_NE(it, points.end());
  EXPECT_FALSE(it->find(spoiled));
  EXPECT_GE(it->observations.size(), 2u);
}

TEST(Window, APointThatManyKeyframesMissGoes) {
  Window window = true_window(5, 0.0);
  const int points = window.activate(2, 2);
  best_point(window).misses = 4;
  window.adjust();
  EXPECT_EQ(window.active_points(), points - 1);
}

// Two views show no scale: depths that all begin too near would draw the baseline after them.
TEST(Window, TheBootstrapKeepsItsScale) {
  Window window = true_window(2, 0.04);
  for (Keyframe& k : window.keyframes())
    for (ImmaturePoint& p : k.immature) p.idepth *= 1.08;
  const double before = relative_pose(window.keyframes()[1], window.keyframes()[0]).translation().norm();
  window.hold_bootstrap_scale();
  window.activate(2, 1);
  window.adjust();
  EXPECT_NEAR(relative_pose(window.keyframes()[1], window.keyframes()[0]).translation().norm(), before,
              0.01 * before);
  EXPECT_LT(pose_error(window.keyframes()[0]).log().norm(), 1e-12);
}

TEST(Window, AnEmptyWindowDoesNothing) {
  Window window = true_window(3, 0.0);
  const WindowStats stats = window.adjust();  // no point is active
  EXPECT_EQ(stats.points, 0);
  EXPECT_EQ(stats.observations, 0);
  for (const Keyframe& k : window.keyframes()) EXPECT_LT(pose_error(k).log().norm(), 1e-9);
  EXPECT_TRUE(window.cloud(window.newest()).empty());
}

}  // namespace
}  // namespace edgevo
