// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/projection.h"

#include <gmock/gmock.h>

#include "edgevo/core/random.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

using test::JacobianNear;
using test::numerical_jacobian;

TEST(Projection, PoseJacobianIsTheDerivativeByALeftPerturbation) {
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
    const auto pixel = [&](const Vector6d& d) {
      const SE3 moved = SE3::exp(d) * T;
      return project(camera, moved.R(), moved.translation(), ray, idepth).px;
    };
    EXPECT_THAT(J, JacobianNear(numerical_jacobian<6>(pixel), 1e-6));
  }
}

TEST(Projection, JacobianOfTheProjection) {
  const Pinhole camera{520, 510, 320, 240, 640, 480};
  const Eigen::Vector3d Y(0.3, -0.2, 1.4);
  const auto pixel = [&](const Eigen::Vector3d& d) -> Eigen::Vector2d { return camera.project(Y + d); };
  EXPECT_THAT(projection_jacobian(camera, Y), JacobianNear(numerical_jacobian<3>(pixel), 1e-7));
}

}  // namespace
}  // namespace edgevo
