// SPDX-License-Identifier: BSD-3-Clause
#include "corner_sight.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

using test::JacobianNear;
using test::numerical_derivative;
using test::numerical_jacobian;

const Pinhole kSightCamera{500, 480, 320, 240, 640, 480};

struct SeenCorner {
  CornerInImage corner;
  SE3 T_cam_anchor;
};

// A corner and a view of it, some pixels off where it is expected.
SeenCorner drawn(unsigned seed) {
  std::mt19937 random(seed);
  const auto at = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  SeenCorner s;
  s.corner.ray = {at(-0.5, 0.5), at(-0.4, 0.4), 1};
  s.corner.idepth = at(0.02, 0.3);
  s.corner.variance = std::pow(at(0.02, 0.2) * s.corner.idepth, 2);
  Vector6d xi;
  xi << at(-1, 1), at(-0.5, 0.5), at(-1, 1), at(-0.05, 0.05), at(-0.1, 0.1), at(-0.1, 0.1);
  s.T_cam_anchor = SE3::exp(xi);
  const Eigen::Vector3d X =
      s.T_cam_anchor.rotation() * s.corner.ray + s.corner.idepth * s.T_cam_anchor.translation();
  s.corner.px = kSightCamera.project(X) + Eigen::Vector2d(at(-3, 3), at(-3, 3));
  return s;
}

CornerSight predicted(const SeenCorner& s) { return predict_corner(s.corner, s.T_cam_anchor, kSightCamera); }

Eigen::Vector2d pixel_at(double idepth, const SE3& T_cam_anchor, const CornerInImage& c) {
  return kSightCamera.project(T_cam_anchor.rotation() * c.ray + idepth * T_cam_anchor.translation());
}

TEST(CornerSight, HasTheDerivativesOfThePixelByPoseAndDepth) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const SeenCorner seen = drawn(seed);
    const CornerSight s = predicted(seen);
    ASSERT_TRUE(s.is_visible);
    const Eigen::Matrix<double, 2, 6> by_pose = numerical_jacobian<6>(
        [&](const Vector6d& xi) -> Eigen::Vector2d {
          return pixel_at(s.idepth, SE3::exp(xi) * seen.T_cam_anchor, seen.corner);
        },
        1e-3);
    EXPECT_THAT(s.J, JacobianNear(by_pose, 1e-7)) << seed;
    for (const int axis : {0, 1}) {
      const auto along = [&](double idepth) {
        return pixel_at(idepth, seen.T_cam_anchor, seen.corner)[axis];
      };
      const double slope = numerical_derivative(along, s.idepth, 1e-4);
      EXPECT_NEAR(s.slope[axis], slope, 1e-6 * (1 + std::abs(slope))) << seed;
    }
  }
}

TEST(CornerSight, WeighsByTheNoiseAndTheUncertainDepth) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const SeenCorner seen = drawn(seed);
    const CornerSight s = predicted(seen);
    const Eigen::Matrix2d covariance = kCornerNoisePx * kCornerNoisePx * Eigen::Matrix2d::Identity() +
                                       seen.corner.variance * s.slope * s.slope.transpose();
    EXPECT_LT((s.weight * covariance - Eigen::Matrix2d::Identity()).norm(), 1e-9) << seed;
  }
}

// What the depth can explain costs as much as its change: no other depth would cost less.
TEST(CornerSight, TheWeighedErrorIsThatOfTheLikeliestDepth) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    SeenCorner seen = drawn(seed);
    const CornerInImage& c = seen.corner;
    const double sigma = std::sqrt(c.variance);
    const CornerSight s = predicted(seen);
    if (std::abs(s.idepth - c.idepth) > 2.9 * sigma) continue;  // held there
    const auto cost = [&](double idepth) {
      const double change = (idepth - c.idepth) / sigma;
      return (c.px - pixel_at(idepth, seen.T_cam_anchor, c)).squaredNorm() /
                 (kCornerNoisePx * kCornerNoisePx) +
             change * change;
    };
    double least = cost(c.idepth);
    for (double at = -4; at <= 4; at += 0.01) least = std::min(least, cost(c.idepth + at * sigma));
    const Eigen::Vector2d off = c.px - s.px;
    EXPECT_NEAR(off.dot(s.weight * off), least, 0.03 * least + 0.03) << seed;
  }
}

TEST(CornerSight, ACornerBehindTheCameraIsNotSeen) {
  SeenCorner seen = drawn(1);
  seen.T_cam_anchor = SE3(Eigen::Quaterniond::Identity(), {0, 0, -2 / seen.corner.idepth});
  EXPECT_FALSE(predicted(seen).is_visible);
}

}  // namespace
}  // namespace edgevo
