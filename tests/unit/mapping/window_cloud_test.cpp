// SPDX-License-Identifier: BSD-3-Clause
// The clouds that the tracker receives from a keyframe of the window.
#include "edgevo/mapping/window.h"

#include <gtest/gtest.h>

#include "window_scene.h"

namespace edgevo {
namespace {

using test::OwnWindow;
using test::seven_keyframes;
using test::Sweep;
using test::true_window;

TEST(Window, TheCloudLiesInTheNewestFrame) {
  OwnWindow window = true_window(5, 0.0);
  window.activate({2, 2});
  const auto cloud = window.cloud(window.newest());
  ASSERT_GT(cloud.size(), 150u);
  std::vector<double> relative, off_edge;
  const PyramidLevel& newest = window.newest().pyramid->finest();
  for (const CloudPoint& p : cloud) {
    const Eigen::Vector2d px = p.px.cast<double>();
    EXPECT_TRUE(Sweep::pinhole().contains(px));
    EXPECT_LT((Sweep::pinhole().project(p.ray) - px).norm(), 1e-3);
    EXPECT_NEAR(p.ray.z(), 1, 1e-12);
    EXPECT_NEAR(p.normal.norm(), 1, 1e-4);
    EXPECT_GT(p.idepth_sigma, 0);
    relative.push_back(std::abs(p.idepth / Sweep::idepth(window.newest().frame_index, px) - 1));
    const int e = newest.field.nearest(p.px.x(), p.px.y());
    if (e >= 0)
      off_edge.push_back(std::abs(
          newest.edges.pixels[size_t(e)].normal().dot(newest.edges.pixels[size_t(e)].position() - p.px)));
  }
  EXPECT_LT(median(relative), 0.002);
  EXPECT_GT(off_edge.size(), 0.95 * double(cloud.size()));
  EXPECT_LT(median(off_edge), 0.25);
}

TEST(Window, TheCloudHoldsAtMostItsLimit) {
  WindowParams params = seven_keyframes();
  params.max_cloud_points = 90;
  OwnWindow window = true_window(5, 0.0, params);
  window.activate({2, 2});
  EXPECT_EQ(window.cloud(window.newest()).size(), 90u);
}

TEST(Window, WhereTheMapIsOutOfViewTheTrackerGetsPointsOfUnknownDepth) {
  OwnWindow window = true_window(3, 0.0);  // no point is active
  const Keyframe& newest = window.newest();
  EXPECT_TRUE(window.cloud(newest).empty());
  const std::vector<CloudPoint> cloud = window.tracking_cloud(newest);
  EXPECT_GT(cloud.size(), 100u);
  EXPECT_LE(cloud.size(), newest.immature.size());
  for (const CloudPoint& p : cloud) {
    EXPECT_GT(p.idepth, 0);
    EXPECT_GT(p.idepth_sigma, 0);
  }
}

TEST(Window, WithoutImmaturePointsTheTrackerGetsOnlyThoseOfKnownDepth) {
  WindowParams params = seven_keyframes();
  params.track_immature_points = false;
  OwnWindow window = true_window(3, 0.0, params);  // no point is active
  EXPECT_TRUE(window.tracking_cloud(window.newest()).empty());
}

TEST(Window, TheCloudOfAnOlderKeyframeIsWhatThatOneSees) {
  OwnWindow window = true_window(5, 0.0);
  window.activate({2, 2});
  const Keyframe& older = window.keyframes()[1];
  const std::vector<CloudPoint> cloud = window.cloud(older);
  EXPECT_GT(cloud.size(), 50u);
  for (const CloudPoint& p : cloud)
    EXPECT_NEAR(p.idepth, Sweep::idepth(older.frame_index, p.px.cast<double>()), 0.1 * p.idepth);
}

}  // namespace
}  // namespace edgevo
