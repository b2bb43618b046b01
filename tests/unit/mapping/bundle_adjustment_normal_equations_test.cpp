// The short pass over a window gives the bits of the whole one.
#include "../../../modules/mapping/src/bundle_adjustment_normal_equations.h"

#include <gtest/gtest.h>

#include "bundle_adjustment_scene.h"

namespace edgevo {
namespace {

constexpr double kHuberWidth = 1.5;

ba_scene::SceneOptions noisy_scene() {
  ba_scene::SceneOptions o;
  o.noise_px = 1;
  o.outlier_share = 0.1;
  o.fixed_point_share = 0.1;
  return o;
}

TEST(NormalEquations, CostAndDepthsAloneAreTheBitsOfTheWhole) {
  BaProblem problem = ba_scene::make_scene(noisy_scene());
  const ba::State state = ba::initial_state(problem, 1e-4);
  const ba::Window window = ba::make_window(problem, state, nullptr);
  ba::NormalEquations whole, part;
  ba::NormalEquationsBuilder builder(window, kHuberWidth);
  builder.build(state, &whole);
  builder.build_cost_and_depths(state, &part);
  EXPECT_GT(whole.cost, 0);
  EXPECT_EQ(part.cost, whole.cost);
  EXPECT_EQ(part.idepth_information, whole.idepth_information);
  EXPECT_EQ(part.idepth_gradient, whole.idepth_gradient);
}

// The camera turned around: all points are behind it, and charged for.
TEST(NormalEquations, PointsBehindTheCameraCostTheSameInBoth) {
  BaProblem problem = ba_scene::make_scene(noisy_scene());
  ba::State state = ba::initial_state(problem, 1e-4);
  const ba::Window window = ba::make_window(problem, state, nullptr);
  state.poses[3] = SE3(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY())), Eigen::Vector3d::Zero()) * state.poses[3];
  ba::NormalEquations whole, part;
  ba::NormalEquationsBuilder builder(window, kHuberWidth);
  builder.build(state, &whole);
  builder.build_cost_and_depths(state, &part);
  EXPECT_GT(whole.cost, 1e5);
  EXPECT_EQ(part.cost, whole.cost);
}

}  // namespace
}  // namespace edgevo
