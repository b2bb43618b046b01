#include "edgevo/alignment/edge_alignment.h"

#include <gtest/gtest.h>

#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

TEST(EdgeAlignment, ResidualJacobian) {
  const Pinhole camera{520, 510, 320, 240, 640, 480};
  const SE3 T = SE3::exp(twist(0.1, -0.05, 0.2, 0.02, 0.03, -0.04));
  const Eigen::Vector3d ray(0.2, -0.1, 1);
  const Eigen::Vector2d match(400, 200), normal = Eigen::Vector2d(0.6, -0.8);
  const EdgeResidual at = edge_residual(camera, T, ray, 0.4, match, normal);
  for (int k = 0; k < 6; ++k) {
    Vector6d d = Vector6d::Zero();
    d[k] = 1e-6;
    const double numeric = (edge_residual(camera, SE3::exp(d) * T, ray, 0.4, match, normal).value -
                            edge_residual(camera, SE3::exp(-d) * T, ray, 0.4, match, normal).value) /
                           2e-6;
    EXPECT_NEAR(at.jacobian[k], numeric, 1e-5 * (1 + std::abs(numeric)));
  }
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

}  // namespace
}  // namespace edgevo
