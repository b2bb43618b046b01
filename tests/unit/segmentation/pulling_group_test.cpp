// SPDX-License-Identifier: BSD-3-Clause
#include "pulling_group.h"

#include <gtest/gtest.h>

#include "edgevo/alignment/edge_alignment.h"
#include "support/pasted_body.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::BodyPlace;
using test::twist;

const BodyPlace kFollowed{120, 80, 70};

// A camera that moves aside and turns before a plane, behind a body that the map has far away.
class FollowedBody : public ::testing::Test {
 protected:
  FollowedBody() {
    reference.cloud = views.cloud(SE3(), kFollowed);
    for (CloudPoint& p : reference.cloud.points)
      if (is_on_body(p)) p.idepth = 1e-3, p.idepth_sigma = 1e-4;
  }
  static bool is_on_body(const CloudPoint& p) {
    return p.px.x() > kFollowed.left && p.px.x() < kFollowed.left + kFollowed.width &&
           p.px.y() > kFollowed.top && p.px.y() < kFollowed.top + kFollowed.width;
  }
  SE3 T_cur_ref() const {
    return SE3::exp(
        twist(kParallaxPx / (fx() * views.scene.idepth(SE3(), {155, 115})), 0, 0, 0, kTurnPx / fx(), 0));
  }
  // The groups found in an image that shows the body moved to the right, at the pose by all points.
  MovingGroup find(double right_px, bool by_near) const {
    const auto frame =
        views.pyramid(T_cur_ref().inverse(), {kFollowed.left + right_px, kFollowed.top, kFollowed.width});
    SE3 pulled = T_cur_ref();
    align_edges(*frame, reference.cloud, 0, AlignmentParams(), &pulled);
    return by_near ? find_pulling_group(*frame, reference, pulled, AlignmentParams())
                   : find_moving_group(*frame, reference.cloud, pulled, AlignmentParams());
  }
  double fx() const { return views.scene.camera.pinhole().fx; }

  static constexpr double kParallaxPx = 4, kTurnPx = 1.6;
  test::SceneWithBody views;
  Reference reference;
};

TEST_F(FollowedBody, IsFoundWhereItPullsThePose) {
  EXPECT_TRUE(find(0, false).points.empty()) << "nothing contradicts the pose";
  const MovingGroup group = find(0, true);
  int on_body = 0, all = 0;
  for (const CloudPoint& p : reference.cloud.points) all += is_on_body(p);
  for (int i : group.points) on_body += is_on_body(reference.cloud.points[size_t(i)]);
  EXPECT_GT(on_body, 0.7 * all);
}

TEST_F(FollowedBody, IsSceneWhereItMovesAsWhatIsFarAway) { EXPECT_TRUE(find(kTurnPx, true).points.empty()); }

TEST_F(FollowedBody, IsSceneWhereTheMapIsKnownToBeWorse) {
  reference.error_factor = 1e4;
  EXPECT_TRUE(find(0, true).points.empty());
}

}  // namespace
}  // namespace edgevo
