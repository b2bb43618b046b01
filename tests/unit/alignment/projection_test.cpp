#include "edgevo/alignment/projection.h"

#include <gtest/gtest.h>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

TEST(Projection, PoseJacobianIsThatOfTheLeftPerturbation) {
  const Pinhole camera{520, 510, 320, 240, 640, 480};
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    Vector6d xi;
    for (int i = 0; i < 6; ++i) xi[i] = 0.3 * random.normal();
    const SE3 T = SE3::exp(xi);
    const Eigen::Vector3d ray(random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5), 1);
    const double idepth = random.uniform(0.1, 0.8);
    const Projection at = project(camera, T.R(), T.translation(), ray, idepth);
    if (!at.valid || at.Y.z() < 0.2) continue;
    const Eigen::Matrix<double, 2, 6> J = pose_jacobian(camera, at.Y, idepth);
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 6; ++k) {
      Vector6d d = Vector6d::Zero();
      d[k] = kStep;
      const SE3 plus = SE3::exp(d) * T, minus = SE3::exp(-d) * T;
      const Eigen::Vector2d numeric = (project(camera, plus.R(), plus.translation(), ray, idepth).px -
                                       project(camera, minus.R(), minus.translation(), ray, idepth).px) /
                                      (2 * kStep);
      EXPECT_LT((J.col(k) - numeric).norm(), 1e-6 * (1 + numeric.norm())) << k;
    }
  }
}

TEST(Projection, JacobianOfTheProjection) {
  const Pinhole camera{520, 510, 320, 240, 640, 480};
  const Eigen::Vector3d Y(0.3, -0.2, 1.4);
  const auto J = projection_jacobian(camera, Y);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d d = 1e-6 * Eigen::Vector3d::Unit(k);
    const Eigen::Vector2d numeric = (camera.project(Y + d) - camera.project(Y - d)) / 2e-6;
    EXPECT_LT((J.col(k) - numeric).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace edgevo
