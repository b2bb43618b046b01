// SPDX-License-Identifier: BSD-3-Clause
#include "rotation_search.h"

#include <gtest/gtest.h>

#include "edgevo/alignment/tracker.h"
#include "support/inlier_scorer.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

class RotationSearch : public ::testing::TestWithParam<Vector6d> {};

TEST_P(RotationSearch, FindsAnUnpredictedRotation) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(GetParam());
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto current = scene.pyramid(T_cur_ref.inverse());
  const auto starts = search_rotation(*current, cloud, SE3());
  ASSERT_FALSE(starts.empty());
  double nearest = 1;
  for (const SE3& T : starts) nearest = std::min(nearest, (T * T_cur_ref.inverse()).angle());
  EXPECT_LT(nearest, 0.06);
  const TrackResult r = track(*current, cloud, {SE3()}, test::InlierScorer(), AlignmentParams());
  EXPECT_GT(r.evidence.inlier_share, 0.4);
  EXPECT_LT((r.T_cur_ref * T_cur_ref.inverse()).angle(), 0.002);
}

INSTANTIATE_TEST_SUITE_P(Turns, RotationSearch,
                         ::testing::Values(twist(0, 0, 0, 0, 0.25, 0), twist(0, 0, 0, 0, -0.3, 0),
                                           twist(0, 0, 0, 0.15, 0.2, 0), twist(0.05, 0, 0.1, -0.15, 0.1, 0)));

}  // namespace
}  // namespace edgevo
