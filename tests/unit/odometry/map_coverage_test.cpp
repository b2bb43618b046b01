// SPDX-License-Identifier: BSD-3-Clause
#include "map_coverage.h"

#include <gtest/gtest.h>

#include "edgevo/odometry/reference.h"

namespace edgevo {
namespace {

Reference reference(int known_points, double view_share) {
  Reference r;
  r.known_points = known_points;
  r.view_share = view_share;
  return r;
}

TrackResult with_matches(double share, double residual_px = 0.5) {
  TrackResult r;
  r.stats.visible = 1000;
  r.stats.inliers = int(1000 * share);
  r.stats.residual_px = residual_px;
  return r;
}

const Reference kInView = reference(1500, 0.6), kAway = reference(50, 0.03), kDark = reference(50, 0.5);
const TrackResult kExplained = with_matches(0.9), kUnexplained = with_matches(0.5);

TEST(MapCoverage, AMapInViewIsInViewWhateverTheMatches) {
  MapCoverage coverage{RecoveryParams()};
  for (int i = 0; i < 50; ++i) EXPECT_EQ(coverage.look(kInView, kUnexplained), Event::kInView);
}

TEST(MapCoverage, BadLightIsNoRotation) {
  MapCoverage coverage{RecoveryParams()};
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(coverage.look(kDark, kUnexplained), Event::kInView) << "few points, but they are in view";
}

TEST(MapCoverage, ARotationThatTheMapExplainsIsFollowed) {
  MapCoverage coverage{RecoveryParams()};
  for (int i = 0; i < 50; ++i) EXPECT_EQ(coverage.look(kAway, kExplained), std::nullopt);
}

TEST(MapCoverage, IsOutOfViewAfterTwelveMoreUnexplainedFrames) {
  MapCoverage coverage{RecoveryParams()};
  for (int i = 0; i < 11; ++i) EXPECT_EQ(coverage.look(kAway, kUnexplained), std::nullopt) << i;
  EXPECT_EQ(coverage.look(kAway, kExplained), std::nullopt);
  EXPECT_EQ(coverage.look(kAway, kUnexplained), std::nullopt);
  EXPECT_EQ(coverage.look(kAway, with_matches(0.9, 1.5)), Event::kOutOfView) << "matched, but a pixel off";
}

TEST(MapCoverage, WithoutABootstrapTheMapIsNeverOutOfView) {
  RecoveryParams params;
  params.bootstrap_out_of_view = false;
  MapCoverage coverage(params);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(coverage.look(kAway, kUnexplained), std::nullopt) << i;
}

TEST(MapCoverage, AMapInViewResetsTheCount) {
  MapCoverage coverage{RecoveryParams()};
  for (int i = 0; i < 20; ++i) (void)coverage.look(kAway, kUnexplained);
  EXPECT_EQ(coverage.look(kInView, kUnexplained), Event::kInView);
  EXPECT_EQ(coverage.look(kAway, kUnexplained), std::nullopt);
}

}  // namespace
}  // namespace edgevo
