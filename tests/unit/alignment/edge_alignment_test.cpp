// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/edge_alignment.h"

#include <gmock/gmock.h>

#include "support/numerical_jacobian.h"
#include "support/plane_scene.h"
#include "support/pose_matchers.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::JacobianNear;
using test::numerical_jacobian;
using test::twist;

TEST(EdgeAlignment, ResidualJacobian) {
  const Pinhole camera{520, 510, 320, 240, 640, 480};
  const SE3 T = SE3::exp(twist(0.1, -0.05, 0.2, 0.02, 0.03, -0.04));
  const Eigen::Vector3d ray(0.2, -0.1, 1);
  const Eigen::Vector2d match(400, 200), normal = Eigen::Vector2d(0.6, -0.8);
  const EdgeResidual at = edge_residual(camera, T, ray, 0.4, match, normal);
  const auto residual = [&](const Vector6d& d) {
    return edge_residual(camera, SE3::exp(d) * T, ray, 0.4, match, normal).value;
  };
  EXPECT_THAT(at.jacobian, JacobianNear(numerical_jacobian<6>(residual), 1e-6));
}

// Points that leave the view must not hold the camera back, nor may a pose win by pushing them out.
TEST(EdgeAlignment, APointOutOfViewCostsHalfAMiss) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto there = scene.pyramid(SE3());
  const AlignmentParams params;
  const double none_in_view = edge_cost(*there, cloud, 0, params, SE3::exp(twist(0, 0, 0, 0, 2, 0)));
  EXPECT_LT(edge_cost(*there, cloud, 0, params, SE3()), 0.2 * none_in_view);
  // Nothing matches in a black image: each point in view costs a miss.
  EXPECT_NEAR(edge_cost(*scene.pyramid(SE3(), 0.0, 0.0), cloud, 0, params, SE3()), 2 * none_in_view,
              0.05 * none_in_view);
}

// A rotation of the image is far off only beyond what it and the prior do not know.
TEST(RotationPrior, WhatIsFarOffDependsOnBothCovariances) {
  const double sigma = 0.002;
  const RotationPrior prior{Eigen::Quaterniond::Identity(), Eigen::Matrix3d::Identity() / (sigma * sigma)};
  const auto far_off = [&](double angle, double image_sigma) {
    return prior.is_far_off(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())),
                            image_sigma * image_sigma * Eigen::Matrix3d::Identity());
  };
  EXPECT_FALSE(far_off(4 * sigma, 0));
  EXPECT_TRUE(far_off(8 * sigma, 0));
  EXPECT_FALSE(far_off(8 * sigma, 2 * sigma));
  EXPECT_TRUE(far_off(16 * sigma, 2 * sigma));
}

}  // namespace
}  // namespace edgevo
