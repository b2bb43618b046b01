// SPDX-License-Identifier: BSD-3-Clause
// The reduced sums over a window have the same bits as the full ones.
#include "normal_equations.h"

#include <gtest/gtest.h>

#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

constexpr double kHuberWidth = 1.5;

test::SceneOptions noisy_scene() {
  test::SceneOptions o;
  o.noise_px = 1;
  o.outlier_share = 0.1;
  o.fixed_point_share = 0.1;
  return o;
}

// A window, and the full and reduced sums at a state.
struct BothPasses {
  BaProblem problem = test::make_scene(noisy_scene());
  ba::State state = ba::initial_state(problem, 1e-4);
  ba::PackedProblem packed = ba::pack_problem(problem, state, nullptr);
  ba::NormalEquations whole, part;

  void run() {
    ba::NormalEquationsBuilder builder(packed, kHuberWidth);
    builder.build(state, &whole);
    builder.build_cost_and_depths(state, &part);
  }
};

TEST(NormalEquations, CostAndDepthsAloneHaveTheSameBits) {
  BothPasses passes;
  passes.run();
  EXPECT_GT(passes.whole.cost, 0);
  EXPECT_EQ(passes.part.cost, passes.whole.cost);
  EXPECT_EQ(passes.part.idepth_information, passes.whole.idepth_information);
  EXPECT_EQ(passes.part.idepth_gradient, passes.whole.idepth_gradient);
}

// One camera turned around: its points are behind it and have their cost.
TEST(NormalEquations, PointsBehindTheCameraCostTheSameInBoth) {
  BothPasses passes;
  SE3& turned = passes.state.poses[3];
  turned =
      SE3(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY())), Eigen::Vector3d::Zero()) *
      turned;
  passes.run();
  EXPECT_GT(passes.whole.cost, 1e5);
  EXPECT_EQ(passes.part.cost, passes.whole.cost);
}

}  // namespace
}  // namespace edgevo
