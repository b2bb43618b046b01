// SPDX-License-Identifier: BSD-3-Clause
// The sums of alignment, computed four points at a time, match those computed point by point.
#include "edge_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/alignment/edge_match.h"
#include "edgevo/core/random.h"

namespace edgevo {
namespace {

constexpr double kMissCost = 2.0;

struct Sums {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double cost = 0, square = 0;
};

Pinhole camera() {
  Pinhole c;
  c.width = 640, c.height = 480;
  c.fx = 500, c.fy = 520, c.cx = 320, c.cy = 240;
  return c;
}

// Both ways over the same `n` random points.
void fill(int n, Sums* one_by_one, Sums* in_lanes) {
  Random random(uint64_t(100 + n));
  const SE3 T = SE3::exp((Vector6d() << 0.3, -0.2, 0.5, 0.02, -0.03, 0.05).finished());
  MatchedEdges edges;
  edges.reserve(size_t(n));
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d ray(random.uniform(-0.6, 0.6), random.uniform(-0.4, 0.4), 1);
    const double idepth = random.uniform(0.02, 0.5), sigma = random.uniform(0, 0.05),
                 angle = random.uniform(0, 6.28);
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    const Projection p = project(camera(), T.R(), T.translation(), ray, idepth);
    const Eigen::Vector2d match = p.px + Eigen::Vector2d(random.uniform(-3, 3), random.uniform(-3, 3));
    const EdgeResidual r = edge_residual(camera(), T, ray, idepth, match, normal);
    const double weight = random.uniform(0.1, 1), cost = random.uniform(0, 4);
    edges.append(p.Y, idepth, sigma, normal, r.value, weight, cost);

    const double w_depth = depth_weight(projection_jacobian(camera(), p.Y), T.translation(), normal, sigma);
    one_by_one->H += w_depth * weight * r.jacobian.transpose() * r.jacobian;
    one_by_one->b += w_depth * weight * r.value * r.jacobian.transpose();
    one_by_one->cost += w_depth * cost + (1 - w_depth) * std::min(cost, kMissCost);
    one_by_one->square += r.value * r.value;
  }
  const EdgeSums sums = sum_edges(edges, camera(), T.translation(), kMissCost);
  sums.add_to(&in_lanes->H, &in_lanes->b);
  in_lanes->cost = sums.cost;
  in_lanes->square = sums.square;
}

TEST(EdgeSums, MatchThoseComputedPointByPoint) {
  for (const int n : {0, 1, 3, 4, 5, 8, 250}) {
    Sums one_by_one, in_lanes;
    fill(n, &one_by_one, &in_lanes);
    EXPECT_LE((in_lanes.H - one_by_one.H).norm(), 1e-12 * one_by_one.H.norm()) << n;
    EXPECT_LE((in_lanes.b - one_by_one.b).norm(), 1e-11 * one_by_one.b.norm()) << n;
    EXPECT_NEAR(in_lanes.cost, one_by_one.cost, 1e-12 * one_by_one.cost) << n;
    EXPECT_NEAR(in_lanes.square, one_by_one.square, 1e-12 * one_by_one.square) << n;
  }
}

}  // namespace
}  // namespace edgevo
