// SPDX-License-Identifier: BSD-3-Clause
// MapGraph on long drives: drift of the scale, and a town of 10,000 keyframes. Times:
// tests/bench/bench_map_graph.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "edgevo/map/map_graph.h"
#include "support/graph_scene.h"

namespace edgevo {
namespace {

using test::covariance_of;
using test::kUnmeasured;

constexpr int kKeyframes = 1000;
constexpr double kStep_m = 2, kDrift = 0.1;

// A path with curves, in metres.
std::vector<Sim3> curved_path() {
  std::vector<Sim3> truth = {Sim3()};
  for (int i = 1; i < kKeyframes; ++i) {
    Vector7d step = Vector7d::Zero();
    step[0] = kStep_m, step[5] = 0.03 * std::sin(i / 40.0);
    truth.push_back(truth.back() * Sim3::exp(step));
  }
  return truth;
}

// Each unit is measured a little too short against the last, well within its standard deviation.
Constraint drifting_step(const std::vector<Sim3>& truth, int i) {
  Constraint c;
  c.from = NodeId::keyframe(i - 1), c.to = NodeId::keyframe(i);
  c.T_from_to = truth[i - 1].inverse() * truth[i];
  c.T_from_to.scale *= std::exp(std::log(1 - kDrift) / (kKeyframes - 1));
  c.covariance = covariance_of(0.01, 1e-3, 3e-3);
  c.centre = c.T_from_to.rigid.translation();
  return c;
}

TEST(MapGraphLarge, TwoMetricScalesUndoADrift) {
  const std::vector<Sim3> truth = curved_path();
  MapGraph graph;
  Sim3 guess;
  graph.add_node(NodeId::keyframe(0), guess);
  for (int i = 1; i < kKeyframes; ++i) {
    const Constraint c = drifting_step(truth, i);
    guess = guess * c.T_from_to;
    graph.add_node(NodeId::keyframe(i), guess);
    graph.add(c);
  }
  Constraint begin;
  begin.to = NodeId::keyframe(0), begin.kind = ConstraintKind::kMetric;
  begin.covariance = covariance_of(0.01, 1e-3, 1e-3);
  graph.add(begin);
  const NodeId last = NodeId::keyframe(kKeyframes - 1);
  graph.add(test::scale_constraint(NodeId::world(), last, 1, 1e-3, ConstraintKind::kMetric));
  EXPECT_NEAR(guess.scale, 1 - kDrift, 1e-6);
  EXPECT_GT((guess.rigid.translation() - truth.back().rigid.translation()).norm(), 20);

  const GraphSolution s = graph.solve();
  EXPECT_TRUE(s.converged);
  for (int i = 0; i < kKeyframes; ++i) {
    const NodeSolution& node = s.nodes.at(NodeId::keyframe(i));
    ASSERT_NEAR(node.T_world_node.scale, 1, 0.002) << i;
    const Eigen::Vector3d error = node.T_world_node.rigid.translation() - truth[i].rigid.translation();
    ASSERT_LT(error.norm(), 0.01 + 0.002 * kStep_m * i) << i;
    // A bridge between two scales of 0.1 %.
    const double u = i * 9e-6, v = (kKeyframes - 1 - i) * 9e-6;
    ASSERT_NEAR(node.log_scale_sigma, std::sqrt(1 / (1 / (1e-6 + u) + 1 / (1e-6 + v))), 1e-4) << i;
  }
}

// chi2 of 7 x 60,000 equations less 7 x 10,000 unknowns, and errors as they must be.
TEST(MapGraphLarge, SolvesATownOfTenThousandKeyframes) {
  const test::GraphScene scene = test::make_graph_scene(test::GraphSceneOptions(), 1);
  ASSERT_EQ(scene.constraints.size(), 60000u);
  MapGraph graph;
  fill_graph(scene, &graph);
  const GraphSolution s = graph.solve(MapGraph::Sigmas::kEpochs);
  EXPECT_TRUE(s.converged);
  const double freedoms = 7.0 * (60000 - 10000);
  EXPECT_NEAR(s.cost, freedoms, 5 * std::sqrt(2 * freedoms));
  double worst_guess = 0;
  for (size_t i = 0; i < scene.truth.size(); ++i) {
    const Sim3& T = s.nodes.at(NodeId::keyframe(static_cast<int>(i))).T_world_node;
    ASSERT_NEAR(std::log(T.scale / scene.truth[i].scale), 0, 0.03) << i;
    worst_guess = std::max(worst_guess, std::abs(std::log(scene.guess[i].scale / scene.truth[i].scale)));
  }
  EXPECT_GT(worst_guess, 0.1);
}

// Ids of the places whose similarity is far from the truth.
std::vector<int> mistaken_places(const test::GraphScene& scene) {
  std::vector<int> mistaken;
  for (size_t k = 0; k < scene.constraints.size(); ++k) {
    const Constraint& c = scene.constraints[k];
    if (!c.failure) continue;
    const Sim3 T = scene.truth[c.from.number()].inverse() * scene.truth[c.to.number()];
    if ((T.inverse() * c.T_from_to).log().norm() > 1) mistaken.push_back(static_cast<int>(k));
  }
  return mistaken;
}

// All of them and no other: at the truth a place would have to be 9 standard deviations off to fail.
TEST(MapGraphLarge, FindsMistakenPlaces) {
  for (const double fraction : {0.05, 0.3}) {
    test::GraphSceneOptions o;
    o.keyframes = 500, o.constraints = 3000, o.mistaken = fraction;
    const test::GraphScene scene = test::make_graph_scene(o, 2);
    MapGraph graph;
    fill_graph(scene, &graph);
    const std::vector<int> mistaken = mistaken_places(scene);
    EXPECT_GT(mistaken.size(), 600 * fraction) << "of 804 places";
    EXPECT_EQ(graph.solve(MapGraph::Sigmas::kNone).failed, mistaken);
  }
}

}  // namespace
}  // namespace edgevo
