// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/image_zoom.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/core/random.h"

namespace edgevo {
namespace {

constexpr double kHalfWidth = 160;

// 150 edges of four points each, seen by a camera at rest, whose lens enlarges the image by `zoom`: what the
// alignment leaves of it, with noise of 0.2 pixels.
ImageZoom found_at(double zoom, double nearest_idepth, double farthest_idepth, uint64_t seed) {
  const Pinhole camera{260, 260, 160, 120, 320, 240};
  Random random(seed);
  std::vector<PoseEquation> equations;
  Matrix6d A = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  for (int edge = 0; edge < 150; ++edge) {
    const Eigen::Vector2d px(random.uniform(10, 310), random.uniform(10, 230));
    const double angle = random.uniform(0, 2 * M_PI),
                 idepth = random.uniform(farthest_idepth, nearest_idepth);
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle)), along(-normal.y(), normal.x());
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d at = px + 3.0 * i * along, from_middle = at - Eigen::Vector2d(160, 120);
      const EdgeResidual r = edge_residual(camera, SE3(), camera.ray(at), idepth, at, normal);
      const double residual = zoom * normal.dot(from_middle) + 0.2 * random.normal();
      equations.push_back({r.jacobian, residual, 1, edge, normal, from_middle / kHalfWidth});
      A += r.jacobian.transpose() * r.jacobian;
      b += r.jacobian.transpose() * residual;
    }
  }
  const Vector6d xi = A.ldlt().solve(b);
  for (PoseEquation& e : equations) e.residual_px -= e.jacobian.dot(xi);
  return image_zoom(equations, kHalfWidth, 2 / (nearest_idepth + farthest_idepth));
}

TEST(ImageZoom, IsFoundWhereDepthsDiffer) {
  double squares = 0;
  constexpr int kTrials = 50;
  for (uint64_t seed = 1; seed <= kTrials; ++seed) {
    const ImageZoom found = found_at(0.03, 0.5, 0.1, seed);
    EXPECT_LT(found.sigma, 0.01);
    EXPECT_NEAR(found.share, 0.03, 4 * found.sigma);
    EXPECT_NEAR(found.feigned_depths, 1, 0.3) << "a step ahead by the zoom times the depth";
    squares += (found.share - 0.03) * (found.share - 0.03) / (found.sigma * found.sigma * kTrials);
  }
  EXPECT_LT(squares, 1.5) << "its standard deviation is right, or too large";
}

TEST(ImageZoom, IsNoneOfALensThatStaysAsItIs) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const ImageZoom found = found_at(0, 0.5, 0.1, seed);
    EXPECT_LT(std::abs(found.share), 4 * found.sigma);
  }
}

TEST(ImageZoom, IsUncertainBeforeAWall) {
  const ImageZoom found = found_at(0.03, 0.2, 0.199, 1);
  EXPECT_GT(found.sigma, 0.03) << "a step towards a wall enlarges all alike";
  EXPECT_TRUE(std::isnan(found_at(0.03, 0.2, 0.2, 1).share)) << "in every way";
}

TEST(ImageZoom, IsUnknownWithoutEquations) { EXPECT_TRUE(std::isnan(image_zoom({}, kHalfWidth, 1).share)); }

}  // namespace
}  // namespace edgevo
