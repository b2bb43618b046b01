// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/map_coverage.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

struct MapView {
  int known_points;
  double view_share;
};
FrameEvidence evidence(const MapView& view, double matched_share) {
  FrameEvidence e;
  e.known_points = view.known_points;
  e.view_share = view.view_share;
  e.visible_points = 1000;
  e.matched_points = int(1000 * matched_share);
  return e;
}

constexpr MapView kInView{1500, 0.6}, kAway{50, 0.03}, kDark{50, 0.5};
constexpr double kExplained = 0.9, kUnexplained = 0.5;

TEST(MapCoverage, AMapInViewIsInViewWhateverTheMatches) {
  MapCoverage coverage(true, StatusParams());
  for (int i = 0; i < 50; ++i) EXPECT_EQ(coverage.look(evidence(kInView, kUnexplained)), MapInView::kYes);
}

TEST(MapCoverage, BadLightIsNoRotation) {
  MapCoverage coverage(true, StatusParams());
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(coverage.look(evidence(kDark, kUnexplained)), MapInView::kYes)
        << "few points, but they are in view";
}

TEST(MapCoverage, ARotationThatTheMapExplainsIsFollowed) {
  MapCoverage coverage(true, StatusParams());
  for (int i = 0; i < 50; ++i) EXPECT_EQ(coverage.look(evidence(kAway, kExplained)), MapInView::kUncertain);
}

TEST(MapCoverage, IsOutOfViewAfterTwelveMoreUnexplainedFrames) {
  MapCoverage coverage(true, StatusParams());
  for (int i = 0; i < 11; ++i)
    EXPECT_EQ(coverage.look(evidence(kAway, kUnexplained)), MapInView::kUncertain) << i;
  EXPECT_EQ(coverage.look(evidence(kAway, kExplained)), MapInView::kUncertain);
  EXPECT_EQ(coverage.look(evidence(kAway, kUnexplained)), MapInView::kUncertain);
  EXPECT_EQ(coverage.look(evidence(kAway, kUnexplained)), MapInView::kNo);
}

TEST(MapCoverage, WithoutABootstrapTheMapIsNeverOutOfView) {
  MapCoverage coverage(false, StatusParams());
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(coverage.look(evidence(kAway, kUnexplained)), MapInView::kUncertain) << i;
}

TEST(MapCoverage, AMapInViewResetsTheCount) {
  MapCoverage coverage(true, StatusParams());
  for (int i = 0; i < 20; ++i) (void)coverage.look(evidence(kAway, kUnexplained));
  EXPECT_EQ(coverage.look(evidence(kInView, kUnexplained)), MapInView::kYes);
  EXPECT_EQ(coverage.look(evidence(kAway, kUnexplained)), MapInView::kUncertain);
}

}  // namespace
}  // namespace edgevo
