// SPDX-License-Identifier: BSD-3-Clause
// Pixels and normals of a map, converted to another correction of the images.
#include <gtest/gtest.h>

#include "edgevo/map/corrected_pixel.h"
#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

TEST(CorrectPixel, CorrectedNormalsAreThoseOfCorrectedEdges) {
  const Pinhole c = test::pinhole();
  const Eigen::Vector2d px(1100, 40), along(0.6, 0.8), normal(-0.8, 0.6);
  ImageMotion motion;
  motion.velocity << 1, 2, -5, 0.2, 0.3, 0.4;
  motion.idepth.setConstant(0.1);
  for (const ImageCorrection& now :
       {ImageCorrection{0.015, 0}, {0.002, 0.03}, {0.01, -0.02}, {0.01, -0.02, 0.2}}) {
    const ImageCorrection before{0.002, 0.005};
    const Eigen::Vector2d a = correct_pixel(c, before, now, motion, px - along),
                          b = correct_pixel(c, before, now, motion, px + along);
    const Eigen::Vector2d corrected = correct_normal(c, before, now, motion, px, normal);
    EXPECT_NEAR(corrected.norm(), 1, 1e-12);
    EXPECT_NEAR(corrected.dot((b - a).normalized()), 0, 1e-4);
    EXPECT_GT(corrected.dot(normal), 0.99);
    EXPECT_LT((correct_pixel(c, now, before, motion, correct_pixel(c, before, now, motion, px)) - px).norm(),
              1e-8);
  }
}

// Points near the axis, as a camera of another focal length sees them: the motion that explains their images.
TEST(CorrectMotion, MovesTheImageAsTheOtherFocalLengthSeesIt) {
  constexpr double kRatio = 0.8;
  const SE3 T = SE3::exp((Vector6d() << 0.1, -0.05, 0.2, 0.02, -0.03, 0.04).finished());
  const SE3 other = correct_motion(T, kRatio);
  for (const double depth : {4.0, 10.0})
    for (const Eigen::Vector2d& x : {Eigen::Vector2d(0.05, 0.02), Eigen::Vector2d(-0.04, 0.06)}) {
      const auto moved = [&](const SE3& motion, const Eigen::Vector2d& from) -> Eigen::Vector2d {
        return (motion * Eigen::Vector3d(depth * from.homogeneous())).hnormalized();
      };
      const Eigen::Vector2d seen = kRatio * moved(T, x);
      EXPECT_LT((moved(other, kRatio * x) - seen).norm(), 0.03 * (seen - kRatio * x).norm());
    }
}

}  // namespace
}  // namespace edgevo
