#include "edgevo/association/warp.h"

#include <gtest/gtest.h>

#include "edgevo/alignment/projection.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

TEST(Warp, AgreesWithNumericDifferentiation) {
  const Pinhole camera{260, 250, 160, 120, 320, 240};
  const SE3 T = SE3::exp(twist(0.2, -0.1, 0.3, 0.05, -0.08, 0.2));
  const Eigen::Vector2d px(100, 80);
  const double idepth = 0.3;
  const auto map = [&](const Eigen::Vector2d& p) {
    return project(camera, T.R(), T.translation(), camera.ray(p), idepth).px;
  };
  const Eigen::Matrix2d A = patch_warp(camera, T, px, idepth);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d d = 1e-4 * Eigen::Vector2d::Unit(k);
    EXPECT_LT((A.col(k) - (map(px + d) - map(px - d)) / 2e-4).norm(), 1e-5);
  }
  // A normal stays perpendicular to the warped edge.
  const Eigen::Vector2d n = Eigen::Vector2d(0.3, -0.9).normalized(), along(-n.y(), n.x());
  EXPECT_NEAR(warp_normal(A, n).dot(A * along), 0, 1e-12);
  EXPECT_GT(warp_normal(A, n).dot(A * n), 0);
}

}  // namespace
}  // namespace edgevo
