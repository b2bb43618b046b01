// SPDX-License-Identifier: BSD-3-Clause
// Corners of a rolling shutter, moved to the time of the middle row: what is left of the skew.
#include "straight_rows.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "edgevo/core/se3.h"

namespace edgevo {
namespace {

constexpr double kReadout = 0.02;  // seconds
constexpr double kFrame = 1.0 / 30;

// A camera that turns at a rate that grows, and moves sideways before points 2 to 6 metres away.
class StraightRows : public ::testing::Test {
 protected:
  const Pinhole pinhole{500, 500, 319.5, 239.5, 640, 480};
  const Rectification rectification{pinhole};
  double sideways = 0;  // metres per second

  // Of points in the camera frame.
  static Eigen::Vector3d rate(double t) { return {0.3 - 4 * t, 0.8 + 6 * t, 0.2}; }
  SE3 pose(double t) const {
    SE3 T;
    const int steps = 200;
    for (int i = 0; i < steps; ++i) {
      Vector6d xi;
      xi << sideways, 0, 0, rate((i + 0.5) * t / steps);
      T = SE3::exp(xi * (t / steps)) * T;
    }
    return T;
  }
  static std::vector<Eigen::Vector3d> points() {
    std::vector<Eigen::Vector3d> all;
    for (int y = -3; y <= 3; ++y)
      for (int x = -4; x <= 4; ++x) {
        const double depth = 4 + (x + 2 * y) % 3;
        all.push_back(depth * Eigen::Vector3d(0.1 * x, 0.1 * y, 1));
      }
    return all;
  }
  // Where the row at which it appears shows a point, of a frame at time t, and where the middle row's time
  // does.
  cv::Point2f seen(const Eigen::Vector3d& X, double t, double readout_s) const {
    Eigen::Vector2d px = pinhole.project(pose(t) * X);
    for (int i = 0; i < 10; ++i)
      px = pinhole.project(pose(t + readout_s * (px.y() / (pinhole.height - 1) - 0.5)) * X);
    return {float(px.x()), float(px.y())};
  }
  std::vector<Corners> views(double readout_s) const {
    std::vector<Corners> all;
    for (double t : seconds()) {
      all.emplace_back();
      for (const Eigen::Vector3d& X : points()) all.back().push_back(seen(X, t, readout_s));
    }
    return all;
  }
  static std::vector<double> seconds() { return {0.05, 0.05 + kFrame, 0.05 + 2 * kFrame, 0.05 + 3 * kFrame}; }
  static std::vector<Timestamp> times() {
    std::vector<Timestamp> all;
    for (double t : seconds()) all.push_back(Timestamp::from_seconds(t));
    return all;
  }
  // Largest distance between the same corners of two sets of views, pixels.
  static double largest_distance(const std::vector<Corners>& a, const std::vector<Corners>& b) {
    double most = 0;
    for (size_t v = 0; v < a.size(); ++v)
      for (size_t i = 0; i < a[v].size(); ++i) most = std::max(most, cv::norm(a[v][i] - b[v][i]));
    return most;
  }
  double left_after_straightening() const {
    const std::vector<Corners> rolling = views(kReadout);
    const std::vector<ImageMotion> motions = turning_motions(pinhole, times(), rolling);
    return largest_distance(straighten_rows(rectification, kReadout, motions, rolling), views(0));
  }
};

TEST_F(StraightRows, TheRateIsFollowedWhileItChanges) {
  const std::vector<ImageMotion> motions = turning_motions(pinhole, times(), views(0));
  for (size_t v = 0; v < motions.size(); ++v) {
    EXPECT_LT((motions[v].velocity.tail<3>() - rate(seconds()[v])).norm(), 0.02) << "view " << v;
    EXPECT_TRUE(motions[v].velocity.head<3>().isZero());
  }
}

TEST_F(StraightRows, AFastTurnLosesItsSkew) {
  EXPECT_GT(largest_distance(views(kReadout), views(0)), 4);
  EXPECT_LT(left_after_straightening(), 0.4);
}

TEST_F(StraightRows, ASidewaysTranslationLosesMostOfIt) {
  sideways = 0.5;
  EXPECT_GT(largest_distance(views(kReadout), views(0)), 4);
  EXPECT_LT(left_after_straightening(), 1.2);
}

TEST_F(StraightRows, AGlobalShutterLeavesTheCornersWhereTheyAre) {
  const std::vector<Corners> global = views(0);
  const std::vector<ImageMotion> motions = turning_motions(pinhole, times(), global);
  EXPECT_LT(largest_distance(straighten_rows(rectification, 0, motions, global), global), 1e-3);
}

TEST_F(StraightRows, EqualTimesGiveNoMotion) {
  const std::vector<Timestamp> same(4, Timestamp::from_seconds(1));
  for (const ImageMotion& m : turning_motions(pinhole, same, views(0))) EXPECT_FALSE(m.is_known());
}

}  // namespace
}  // namespace edgevo
