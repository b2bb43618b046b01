// SPDX-License-Identifier: BSD-3-Clause
// Errors that neighbouring edges share: found in residuals, and covered where pose_covariance() is too sure.
#include "edgevo/alignment/correlated_residual.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/alignment/tracker.h"
#include "edgevo/core/random.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

constexpr double kOwnPx = 0.3;  // noise of a residual

// 150 edges of four points each, at different depths, seen by a camera at rest.
std::vector<PoseEquation> make_equations() {
  const Pinhole camera{260, 260, 160, 120, 320, 240};
  Random random(5);
  std::vector<PoseEquation> equations;
  for (int edge = 0; edge < 150; ++edge) {
    const Eigen::Vector2d px(random.uniform(10, 310), random.uniform(10, 230));
    const double angle = random.uniform(0, 2 * M_PI), idepth = random.uniform(0.1, 0.5);
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle)), along(-normal.y(), normal.x());
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d at = px + 3.0 * i * along;
      const EdgeResidual r = edge_residual(camera, SE3(), camera.ray(at), idepth, at, normal);
      equations.push_back({r.jacobian, 0, 1, edge, normal, (at - Eigen::Vector2d(160, 120)) / 160});
    }
  }
  return equations;
}

// Poses from residuals with noise of their own and an affine motion of the image.
struct Trials {
  double variance_px2 = 0;               // found in all of them
  double by_edges = 0, with_smooth = 0;  // mean normalised error squared, over its degrees of freedom
};

Trials run(double smooth_px) {
  constexpr int kTrials = 1000;
  std::vector<PoseEquation> equations = make_equations();
  Matrix6d A = Matrix6d::Zero();
  for (const PoseEquation& e : equations) A += e.jacobian.transpose() * e.jacobian;
  const auto solver = A.ldlt();
  Random random(7);
  Trials trials;
  CorrelatedResidual sum;
  for (int trial = 0; trial < kTrials; ++trial) {
    Vector6d theta, b = Vector6d::Zero();
    for (double& x : theta) x = smooth_px * random.normal();
    for (PoseEquation& e : equations) {
      const Eigen::Vector3d affine(1, e.at.x(), e.at.y());
      e.residual_px = kOwnPx * random.normal() + e.normal.x() * affine.dot(theta.head<3>()) +
                      e.normal.y() * affine.dot(theta.tail<3>());
      b += e.jacobian.transpose() * e.residual_px;
    }
    const Vector6d xi = solver.solve(b);
    for (PoseEquation& e : equations) e.residual_px -= e.jacobian.dot(xi);  // as the alignment leaves them
    const CorrelatedResidual found = correlated_residual(equations);
    sum.explained_px2 += found.explained_px2, sum.per_px2 += found.per_px2;
    const Matrix6d by_edges = pose_covariance(equations) / kReferenceShare;
    trials.by_edges += xi.dot(by_edges.ldlt().solve(xi)) / (6 * kTrials);
    const Matrix6d both = by_edges + smooth_px * smooth_px * found.covariance;
    trials.with_smooth += xi.dot(both.ldlt().solve(xi)) / (6 * kTrials);
  }
  trials.variance_px2 = sum.explained_px2 / sum.per_px2;
  return trials;
}

TEST(CorrelatedResidual, IsNoneUnderIndependentNoise) {
  const Trials t = run(0);
  EXPECT_LT(std::abs(t.variance_px2), 0.02 * kOwnPx * kOwnPx);
  EXPECT_LT(t.by_edges, 1.1);
}

TEST(CorrelatedResidual, IsFoundThoughThePoseAbsorbsMostOfIt) {
  EXPECT_NEAR(run(0.5).variance_px2, 0.25, 0.05);
  EXPECT_NEAR(run(0.1).variance_px2, 0.01, 0.003);
}

TEST(CorrelatedResidual, CoversThePoseWhereEdgesAloneAreTooSure) {
  const Trials t = run(0.5);
  EXPECT_GT(t.by_edges, 10);
  EXPECT_GT(t.with_smooth, 0.7);  // edges count a part of it as theirs: on the safe side
  EXPECT_LT(t.with_smooth, 1.05);
}

TEST(CorrelatedResidual, WithoutEquationsNothingIsFound) {
  const CorrelatedResidual found = correlated_residual({});
  EXPECT_EQ(found.variance_px2(), 0);
  EXPECT_TRUE(found.covariance.isZero());
}

// Rows that are exposed one after the other shear the image of a camera that turns.
TEST(CorrelatedResidual, ShowsAShearedImage) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.1, 0, 0.1, 0.01, -0.02, 0));
  const auto current = scene.pyramid(T_cur_ref.inverse());
  ReferenceCloud cloud = scene.cloud(SE3());
  const auto variance = [&] {
    PoseCandidate pose;
    pose.T_cur_ref = T_cur_ref;
    align_edges(*current, cloud, 0, AlignmentParams(), &pose.T_cur_ref);
    return assess(*current, cloud, pose, AlignmentParams()).correlated_px2;
  };
  const double exact = variance();
  for (CloudPoint& p : cloud.points) p.ray.x() += 0.01 * p.ray.y();
  EXPECT_GT(variance(), 10 * exact + 0.01);
}

}  // namespace
}  // namespace edgevo
