// SPDX-License-Identifier: BSD-3-Clause
// The sliding window: which points become active and are matched, and what a keyframe takes with it when it
// leaves.
#include "edgevo/mapping/window.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "window_scene.h"

namespace edgevo {
namespace {

using test::idepth_error;
using test::kFramesApart;
using test::OwnWindow;
using test::seven_keyframes;
using test::Sweep;
using test::sweep_pose;
using test::tracking_covariance;
using test::true_window;

// ---- activation ----

TEST(Window, ActivatesPointsThatKeyframesMatch) {
  OwnWindow window = true_window(4, 0.02);
  const int n = window.activate({2, 2});
  EXPECT_GT(n, 200);
  EXPECT_EQ(n, window.active_points());
  for (const Keyframe& k : window.keyframes())
    for (const MapPoint& p : k.points) {
      EXPECT_GE(p.observations.size(), 2u);
      for (size_t i = 0; i < p.observations.size(); ++i) {
        EXPECT_NE(p.observations[i].keyframe_id, k.id);
        EXPECT_GT(p.observations[i].keyframe_id, i > 0 ? p.observations[i - 1].keyframe_id : -1);
      }
    }
}

// New points between keyframes 0.1 apart, say, share the error of that length; points of before do not.
TEST(Window, NewPointsCarryTheUnitByTheBaselineTheyAreSeenOver) {
  const auto carried = [](double position_sigma) {
    OwnWindow window = true_window(4, 0.02);
    window.associate_newest(position_sigma * position_sigma * Matrix6d::Identity());
    window.activate({2, 2});
    return window.carried_unit_variance();
  };
  EXPECT_EQ(carried(0), 0);
  const double some = carried(1e-3);
  EXPECT_GT(some, 0);
  EXPECT_NEAR(carried(2e-3) / some, 4, 1e-6);
  EXPECT_NEAR(carried(1e3), 1, 0.01) << "nothing is known";

  OwnWindow window = true_window(4, 0.02);
  window.activate({2, 2});
  window.associate_newest(Matrix6d::Identity());
  EXPECT_EQ(window.carried_unit_variance(), 0) << "all points are of before";
}

TEST(Window, ActivationIsSpreadOverTheNewestImage) {
  const WindowParams params = seven_keyframes();
  OwnWindow window = true_window(4, 0.0, params);
  ASSERT_GT(window.activate({2, 2}), 200);
  const CellGrid grid(320, 240, kActivationCellPx);
  std::vector<int> count(size_t(grid.size()), 0);
  for (const Keyframe& k : window.keyframes()) {
    const SE3 T = relative_pose(window.newest(), k);
    for (const MapPoint& p : k.points) {
      const Projection at =
          project(Sweep::pinhole(), T.R(), T.translation(), Sweep::pinhole().ray(p.px), p.idepth);
      ++count[size_t(grid.index(at.px.x(), at.px.y()))];
    }
  }
  EXPECT_LE(*std::max_element(count.begin(), count.end()), 2);
}

TEST(Window, ActivationRequiresEnoughMeasurementsAndCertainty) {
  OwnWindow window = true_window(4, 0.02);
  EXPECT_EQ(window.activate({4, 2}), 0);  // three good measurements each
  for (Keyframe& k : window.keyframes())
    for (ImmaturePoint& p : k.immature) p.idepth_sigma = p.idepth;
  EXPECT_EQ(window.activate({2, 2}), 0);
}

// Two keyframes show each point in one other view: it is not lost for lack of a second view that has not been
// taken yet.
TEST(Window, APointWaitsUntilEnoughKeyframesSeeIt) {
  OwnWindow window = true_window(2, 0.02);
  EXPECT_EQ(window.activate({2, 2}), 0);
  for (const Keyframe& k : window.keyframes())
    EXPECT_TRUE(
        std::none_of(k.immature.begin(), k.immature.end(), [](const ImmaturePoint& p) { return p.dead; }));
  Random random(17);
  window.add(test::true_keyframe(2, 2 * kFramesApart, 0.02, &random));
  window.newest().immature.clear();
  EXPECT_GT(window.activate({2, 2}), 150);
}

TEST(Window, ActivationStopsAtTheLimit) {
  WindowParams params = seven_keyframes();
  params.max_points = 120;
  OwnWindow window = true_window(4, 0.02, params);
  EXPECT_EQ(window.activate({2, 2}), 120);
  EXPECT_EQ(window.activate({2, 2}), 0);
}

// ---- tentative points ----

constexpr int kBudget = 100;

// With two keyframes each point has one match at most.
OwnWindow window_of_two() {
  OwnWindow window = true_window(2, 0.02);
  for (Keyframe& k : window.keyframes())
    for (ImmaturePoint& p : k.immature) p.good = 1;
  return window;
}

void add_third(Window* window) {
  Random random(17);
  window->add(test::true_keyframe(2, 2 * kFramesApart, 0.02, &random));
  window->newest().immature.clear();
}

template <typename Test>
int count_immature(const Window& window, const Test& test) {
  int n = 0;
  for (const Keyframe& k : window.keyframes())
    n += int(std::count_if(k.immature.begin(), k.immature.end(), test));
  return n;
}

// At 320x240 a quarter of the cells of 14 pixels is less than 500.
TEST(Window, ActivatesAsManyTentativePointsAsTrackingLacks) {
  OwnWindow window = window_of_two();
  const int cells = CellGrid(320, 240, kActivationCellPx).size();
  EXPECT_EQ(window.points_lacking(), cells / 4) << "there is none";
  EXPECT_EQ(window.activate({1, 1, window.points_lacking()}), cells / 4);
  EXPECT_EQ(window.active_points(), cells / 4);
  EXPECT_EQ(count_immature(window, [](const ImmaturePoint& p) { return p.tentative && !p.dead; }), cells / 4);
  EXPECT_EQ(window.points_lacking(), 0);
}

TEST(Window, ATentativePointStaysWhereTheNextKeyframeMatchesIt) {
  OwnWindow window = window_of_two();
  const int tentative = window.activate({1, 1, kBudget});
  add_third(&window);
  window.associate_newest(tracking_covariance());
  window.demote_unconfirmed();
  const int stayed = window.active_points();
  EXPECT_GT(stayed, tentative / 2);
  for (const Keyframe& k : window.keyframes())
    for (const MapPoint& p : k.points) {
      EXPECT_FALSE(p.tentative);
      EXPECT_GE(p.observations.size(), 2u);
    }
  EXPECT_EQ(count_immature(window, [](const ImmaturePoint& p) { return p.dead; }), stayed);
}

TEST(Window, AnUnconfirmedTentativePointBecomesImmature) {
  OwnWindow window = window_of_two(), untouched = window_of_two();
  ASSERT_GT(window.activate({1, 1, kBudget}), 50);
  add_third(&window);
  add_third(&untouched);
  window.demote_unconfirmed();  // nothing was matched in the third
  EXPECT_EQ(window.active_points(), 0);
  EXPECT_EQ(count_immature(window, [](const ImmaturePoint& p) { return p.tentative || p.dead; }), 0);
  EXPECT_EQ(window.activate({1, 2}), untouched.activate({1, 2}));
}

TEST(Window, APointOfTwoDepthsIsNotTentative) {
  OwnWindow window = true_window(2, 0.02);
  for (Keyframe& k : window.keyframes())
    for (ImmaturePoint& p : k.immature) p.good = 2;
  ASSERT_EQ(window.activate({1, 1, kBudget}), kBudget);
  add_third(&window);
  window.demote_unconfirmed();  // nothing was matched in the third
  EXPECT_EQ(window.active_points(), kBudget);
}

TEST(Window, AnImmaturePointGivenUpWhileItsPointWasTentativeStaysGivenUp) {
  OwnWindow window = window_of_two();
  const int tentative = window.activate({1, 1, kBudget});
  for (Keyframe& k : window.keyframes())
    for (ImmaturePoint& p : k.immature) p.dead = p.tentative;  // as the depth filter does
  add_third(&window);
  window.demote_unconfirmed();
  EXPECT_EQ(window.active_points(), 0);
  EXPECT_EQ(count_immature(window, [](const ImmaturePoint& p) { return p.dead; }), tentative);
}

TEST(Window, ATentativePointThatTheAdjustmentDroppedIsGone) {
  OwnWindow window = window_of_two();
  const int tentative = window.activate({1, 1, kBudget});
  for (Keyframe& k : window.keyframes()) k.points.clear();
  window.demote_unconfirmed();
  EXPECT_EQ(count_immature(window, [](const ImmaturePoint& p) { return p.dead; }), tentative);
  EXPECT_EQ(count_immature(window, [](const ImmaturePoint& p) { return p.tentative; }), 0);
}

// ---- association ----

TEST(Window, MatchesMostPointsWithTheNewestKeyframe) {
  OwnWindow window = true_window(4, 0.0);
  window.activate({2, 2});
  const int points = window.active_points();
  Random random(3);
  window.add(test::true_keyframe(9, 4 * kFramesApart, 0.0, &random));
  const int matches = window.associate_newest(tracking_covariance());
  EXPECT_GT(matches, 0.7 * points);
  std::vector<double> off;
  for (const Keyframe& host : window.keyframes()) {
    const SE3 T = relative_pose(window.newest(), host);
    for (const MapPoint& p : host.points)
      if (const Observation* seen = p.find(9)) {
        const Projection at =
            project(Sweep::pinhole(), T.R(), T.translation(), Sweep::pinhole().ray(p.px), p.idepth);
        off.push_back(std::abs(seen->match.normal.dot(seen->match.px - at.px)));
      }
  }
  EXPECT_EQ(int(off.size()), matches);
  EXPECT_LT(median(off), 0.15);
}

TEST(Window, CountsMissesWhereTheNewestKeyframeIsBlank) {
  OwnWindow window = true_window(4, 0.0);
  window.activate({2, 2});
  Random random(3);
  Keyframe blank = test::true_keyframe(9, 4 * kFramesApart, 0.0, &random);
  blank.immature.clear();
  blank.pyramid = PyramidBuilder(Sweep::scene().camera, EdgeParams())
                      .build(test::make_image(320, 240, [](double, double) { return 80; }));
  window.add(std::move(blank));
  EXPECT_EQ(window.associate_newest(tracking_covariance()), 0);
  int misses = 0;
  for (const Keyframe& host : window.keyframes())
    for (const MapPoint& p : host.points) misses += p.misses;
  EXPECT_GT(misses, 0.8 * window.active_points());
  EXPECT_TRUE(window.cloud(window.newest()).empty());
}

// ---- leaving ----

TEST(Window, TheOldestLeavesNoTrace) {
  OwnWindow window = true_window(6, 0.02);
  window.activate({2, 2});
  window.adjust();
  const size_t hosted = window.keyframes().front().points.size();
  const Keyframe oldest = window.remove_oldest();
  EXPECT_EQ(oldest.id, 0);
  EXPECT_EQ(oldest.points.size(), hosted);
  EXPECT_EQ(window.keyframes().front().id, 1);
  for (const Keyframe& k : window.keyframes())
    for (const MapPoint& p : k.points) {
      EXPECT_TRUE(!p.observations.empty() || p.known_sigma > 0);
      EXPECT_EQ(p.find(0), nullptr);
    }
}

TEST(Window, AdjustingAfterARemovalKeepsPosesAndDepths) {
  OwnWindow window = true_window(6, 0.02);
  window.activate({2, 2});
  window.adjust();
  window.remove_oldest();
  for (int i = 0; i < 3; ++i) window.adjust();
  const Keyframe &first = window.keyframes().front(), &last = window.newest();
  const double baseline =
      (sweep_pose(last.frame_index).translation() - sweep_pose(first.frame_index).translation()).norm();
  EXPECT_NEAR(relative_pose(last, first).translation().norm(), baseline, 0.03 * baseline);
  EXPECT_LT(idepth_error(window), 0.03);
}

}  // namespace
}  // namespace edgevo
