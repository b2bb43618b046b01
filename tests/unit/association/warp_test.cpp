// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/warp.h"

#include <gmock/gmock.h>

#include "edgevo/alignment/projection.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

TEST(Warp, AgreesWithNumericDifferentiation) {
  const Pinhole camera{260, 250, 160, 120, 320, 240};
  const SE3 T = SE3::exp(twist(0.2, -0.1, 0.3, 0.05, -0.08, 0.2));
  const Eigen::Vector2d px(100, 80);
  const double idepth = 0.3;
  const auto moved = [&](const Eigen::Vector2d& d) {
    return project(camera, T.R(), T.translation(), camera.ray(px + d), idepth).px;
  };
  const Eigen::Matrix2d A = patch_warp(camera, T, px, idepth);
  EXPECT_THAT(A, test::JacobianNear(test::numerical_jacobian<2>(moved, 1e-3), 1e-6));
  // A normal stays perpendicular to the warped edge.
  const Eigen::Vector2d n = Eigen::Vector2d(0.3, -0.9).normalized(), along(-n.y(), n.x());
  EXPECT_NEAR(warp_normal(A, n).dot(A * along), 0, 1e-12);
  EXPECT_GT(warp_normal(A, n).dot(A * n), 0);
}

}  // namespace
}  // namespace edgevo
