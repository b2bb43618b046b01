// SPDX-License-Identifier: BSD-3-Clause
// Poses of views that were only tracked, in a scene whose depth is exact.
#include "view_poses.h"

#include <gtest/gtest.h>

#include "edgevo/core/random.h"
#include "support/sweep_scene.h"

namespace edgevo {
namespace {

using test::Sweep;

constexpr int kHost = 12, kView = 16;

std::vector<CloudPoint> points_of_host() {
  std::vector<CloudPoint> points;
  const ImageEdges& edges = Sweep::pyramid(kHost)->finest().edges;
  for (size_t i = 0; i < edges.pixels.size(); i += 20) {
    CloudPoint p;
    p.px = edges.pixels[i].position(), p.normal = edges.pixels[i].normal();
    p.ray = Sweep::pinhole().ray(p.px.cast<double>());
    p.idepth = Sweep::idepth(kHost, p.px.cast<double>()), p.idepth_sigma = 0.01 * p.idepth;
    if (p.idepth > 0) points.push_back(p);
  }
  return points;
}

SE3 true_motion() { return test::sweep_pose(kView).inverse() * test::sweep_pose(kHost); }

EdgeView tracked_view(const SE3& error) {
  const auto pyramid = Sweep::pyramid(kView);
  EdgeView view{pyramid, std::make_shared<const std::vector<EdgeSides>>(sample_sides(pyramid->finest())),
                error * true_motion(), 1, true};
  return view;
}

double error_of(const EdgeView& view) {
  return (view.T_view_host.translation() - true_motion().translation()).norm();
}

TEST(ViewPoses, AreThoseThatLinesSay) {
  Random random(3);
  for (int i = 0; i < 5; ++i) {
    Vector6d xi;
    for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? 0.03 : 0.002) * random.uniform(-1, 1);
    std::vector<EdgeView> views{tracked_view(SE3::exp(xi)), tracked_view(SE3::exp(xi))};
    views[1].is_tracked = false;  // adjusted since
    const double before = error_of(views[0]);
    align_tracked_views(points_of_host(), {}, &views);
    EXPECT_LT(error_of(views[0]), 0.5 * before + 0.002);
    EXPECT_EQ(error_of(views[1]), before);
  }
}

TEST(ViewPoses, StayWhereTooFewLinesAreKnown) {
  std::vector<EdgeView> views{tracked_view(SE3::exp(Vector6d::Constant(0.002)))};
  const double before = error_of(views[0]);
  std::vector<CloudPoint> few = points_of_host();
  few.resize(20);
  align_tracked_views(few, {}, &views);
  EXPECT_EQ(error_of(views[0]), before);
}

// The lines of another place: an alignment that converges somewhere is none.
TEST(ViewPoses, StayWhereTheImageDoesNotSupportNewOnes) {
  std::vector<EdgeView> views{tracked_view(SE3::exp(Vector6d::Constant(0.002)))};
  const double before = error_of(views[0]);
  Random random(7);
  std::vector<CloudPoint> elsewhere = points_of_host();
  for (CloudPoint& p : elsewhere) {
    const double angle = random.uniform(0, 6.28);
    p.px = {float(random.uniform(20, Sweep::pinhole().width - 20)),
            float(random.uniform(20, Sweep::pinhole().height - 20))};
    p.normal = {float(std::cos(angle)), float(std::sin(angle))};
    p.ray = Sweep::pinhole().ray(p.px.cast<double>());
  }
  align_tracked_views(elsewhere, {}, &views);
  EXPECT_EQ(error_of(views[0]), before);
}

TEST(ViewPoses, FollowTheSettingsOfTheRun) {
  std::vector<EdgeView> views{tracked_view(SE3::exp(Vector6d::Constant(0.002)))};
  const double before = error_of(views[0]);
  ViewAlignment strict;
  strict.status.degraded_share = 1;
  align_tracked_views(points_of_host(), strict, &views);
  EXPECT_EQ(error_of(views[0]), before);
}

}  // namespace
}  // namespace edgevo
