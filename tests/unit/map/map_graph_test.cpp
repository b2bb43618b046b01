// SPDX-License-Identifier: BSD-3-Clause
// MapGraph on small graphs: closed forms, mixtures, withdrawal, order, gauge, refusals, threads.
#include "edgevo/map/map_graph.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <thread>

#include "support/graph_scene.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

using test::covariance_of;
using test::kUnmeasured;
using test::scale_constraint;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const NodeId kA = NodeId::epoch(0, 0), kB = NodeId::epoch(0, 1), kC = NodeId::epoch(1, 0);

Sim3 some_place(Random& random) {
  Vector7d xi = test::normal_tangent(random);
  xi[6] *= 0.3;
  return Sim3::exp(xi);
}

// Three epochs, the first of a known scale.
void add_epochs(MapGraph* graph) {
  for (const NodeId id : {kA, kB, kC}) graph->add_node(id, Sim3());
  graph->add(scale_constraint(NodeId::world(), kA, 1, 1e-6, ConstraintKind::kMetric));
}

double scale_of(const GraphSolution& s, NodeId id) { return s.nodes.at(id).T_world_node.scale; }
double sigma_of(const GraphSolution& s, NodeId id) { return s.nodes.at(id).log_scale_sigma; }

Constraint continuity(NodeId from, NodeId to) {
  Constraint c = scale_constraint(from, to, 1, 0.01, ConstraintKind::kContinuity);
  c.failure = {0.3, covariance_of(kUnmeasured, kUnmeasured, 1)};
  return c;
}

// Nodes 0..n-1 at random places, all pairs measured with noise; guesses off the truth.
struct SmallGraph {
  std::vector<std::pair<NodeId, Sim3>> guesses;
  std::vector<Constraint> constraints;
};

SmallGraph small_graph(int n, const Matrix7d& covariance, Random& random) {
  std::vector<Sim3> truth = {Sim3()};
  std::vector<NodeId> ids = {NodeId::world()};
  SmallGraph g;
  for (int i = 0; i < n; ++i) {
    truth.push_back(some_place(random));
    if (covariance(6, 6) == 0) truth.back().scale = 1;
    ids.push_back(NodeId::keyframe(i));
    Sim3 guess = Sim3::exp(0.1 * test::normal_tangent(random)) * truth.back();
    if (covariance(6, 6) == 0) guess.scale = 1;
    g.guesses.emplace_back(ids.back(), guess);
  }
  for (int i = 0; i <= n; ++i)
    for (int j = i + 1; j <= n; ++j)
      g.constraints.push_back(test::noisy_constraint(ids[i], ids[j], truth[i].inverse() * truth[j],
                                                     covariance, ConstraintKind::kNeighbour, random));
  return g;
}

void fill(const SmallGraph& g, MapGraph* graph) {
  for (const auto& [id, T] : g.guesses) graph->add_node(id, T);
  for (const Constraint& c : g.constraints) graph->add(c);
}

double distance(const Sim3& a, const Sim3& b) { return (a * b.inverse()).log().norm(); }

void expect_same_bits(const GraphSolution& a, const GraphSolution& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (const auto& [id, node] : a.nodes) {
    const NodeSolution& other = b.nodes.at(id);
    EXPECT_EQ(node.T_world_node.scale, other.T_world_node.scale) << id;
    EXPECT_EQ(node.T_world_node.rigid.matrix(), other.T_world_node.rigid.matrix()) << id;
    EXPECT_EQ(node.log_scale_sigma, other.log_scale_sigma) << id;
  }
  EXPECT_EQ(a.cost, b.cost);
}

TEST(MapGraph, ScalesAreTheWeightedMeanOfWhatIsMeasured) {
  MapGraph graph;
  add_epochs(&graph);
  graph.add(scale_constraint(kA, kB, 1.5, 0.5, ConstraintKind::kSpeed));
  graph.add(scale_constraint(kA, kB, 2.0, 0.03, ConstraintKind::kFeatures));
  graph.add(scale_constraint(kB, kC, 0.7, 0.5, ConstraintKind::kSpeed));
  const GraphSolution s = graph.solve();
  const double w_speed = 1 / (0.5 * 0.5), w_features = 1 / (0.03 * 0.03);
  const double log_b = (w_speed * std::log(1.5) + w_features * std::log(2.0)) / (w_speed + w_features);
  const double variance_b = 1e-12 + 1 / (w_speed + w_features);
  EXPECT_NEAR(std::log(scale_of(s, kB)), log_b, 1e-12);
  EXPECT_NEAR(std::log(scale_of(s, kC)), log_b + std::log(0.7), 1e-12);
  EXPECT_NEAR(sigma_of(s, kA), 1e-6, 1e-12);
  EXPECT_NEAR(sigma_of(s, kB), std::sqrt(variance_b), 1e-9);
  EXPECT_NEAR(sigma_of(s, kC), std::sqrt(variance_b + 0.25), 1e-9);
  EXPECT_TRUE(s.converged);
  EXPECT_EQ(sigma_of(s, NodeId::world()), 0);
}

TEST(MapGraph, UnitIsKeptWhereFeaturesAgree) {
  MapGraph graph;
  add_epochs(&graph);
  graph.add(continuity(kA, kB));
  graph.add(scale_constraint(kA, kB, 1.02, 0.03, ConstraintKind::kFeatures));
  const GraphSolution s = graph.solve();
  EXPECT_THAT(s.failed, IsEmpty());
  EXPECT_NEAR(scale_of(s, kB), 1, 0.003);
}

TEST(MapGraph, UnitHasChangedWhereFeaturesSaySo) {
  MapGraph graph;
  add_epochs(&graph);
  const int kept = graph.add(continuity(kA, kB));
  graph.add(scale_constraint(kA, kB, 0.5, 0.03, ConstraintKind::kFeatures));
  const GraphSolution s = graph.solve();
  EXPECT_THAT(s.failed, ElementsAre(kept));
  EXPECT_NEAR(scale_of(s, kB), 0.5, 0.005);
  EXPECT_NEAR(sigma_of(s, kB), 0.03, 1e-4);
}

TEST(MapGraph, NamesTheConstraintThatIsWrong) {
  MapGraph graph;
  add_epochs(&graph);
  graph.add(scale_constraint(kA, kB, 1, 0.02, ConstraintKind::kFeatures));
  Constraint wrong = scale_constraint(kA, kB, 8, 0.001, ConstraintKind::kPlace);
  wrong.failure = {0.01, covariance_of(kUnmeasured, kUnmeasured, 3)};
  const int id = graph.add(wrong);
  const GraphSolution s = graph.solve();
  EXPECT_THAT(s.failed, ElementsAre(id));
  EXPECT_NEAR(scale_of(s, kB), 1, 0.002);
}

// The two that agree are true although a third, that claims more precision, draws both to its side.
TEST(MapGraph, ChoosesModesTogether) {
  MapGraph graph;
  add_epochs(&graph);
  std::vector<int> ids;
  for (const double scale : {1.0, 1.01, 3.0}) {
    Constraint c = scale_constraint(kA, kB, scale, scale == 3 ? 0.005 : 0.02, ConstraintKind::kPlace);
    c.failure = {0.1, covariance_of(kUnmeasured, kUnmeasured, 1)};
    ids.push_back(graph.add(c));
  }
  const GraphSolution s = graph.solve();
  EXPECT_THAT(s.failed, ElementsAre(ids[2]));
  EXPECT_NEAR(scale_of(s, kB), 1.005, 0.002);
}

TEST(MapGraph, CostIsThatOfTheModes) {
  MapGraph graph;
  add_epochs(&graph);
  graph.add(continuity(kA, kB));
  graph.add(scale_constraint(kA, kB, 0.5, 1e-6, ConstraintKind::kFeatures));
  const double chi2 = std::pow(std::log(0.5), 2);
  EXPECT_NEAR(graph.solve().cost, chi2 + 2 * std::log(1 / 0.01) - 2 * std::log(0.3 / 0.7), 1e-6);
}

TEST(MapGraph, WithdrawalGivesTheSolutionWithout) {
  Random random(3);
  const SmallGraph g = small_graph(4, covariance_of(0.05, 0.02, 0.05), random);
  MapGraph without, withdrawn;
  fill(g, &without), fill(g, &withdrawn);
  const GraphSolution expected = without.solve();
  Constraint other = g.constraints[2];
  other.T_from_to = some_place(random);
  Constraint rigid = other;
  rigid.covariance = covariance_of(0.1, 0.1, 0);
  const int id = withdrawn.add(other), rigid_id = withdrawn.add(rigid);
  EXPECT_GT(
      distance(withdrawn.solve().nodes.at(other.to).T_world_node, expected.nodes.at(other.to).T_world_node),
      1e-3);
  withdrawn.withdraw(id), withdrawn.withdraw(rigid_id);
  expect_same_bits(withdrawn.solve(), expected);
  EXPECT_EQ(withdrawn.constraints().size(), g.constraints.size());
}

TEST(MapGraph, OrderOfInsertionDoesNotMatter) {
  Random random(4);
  const SmallGraph g = small_graph(5, covariance_of(0.05, 0.02, 0.05), random);
  SmallGraph reversed = g;
  std::reverse(reversed.guesses.begin(), reversed.guesses.end());
  std::reverse(reversed.constraints.begin(), reversed.constraints.end());
  MapGraph first, again, other;
  fill(g, &first), fill(g, &again), fill(reversed, &other);
  const GraphSolution a = first.solve(), b = other.solve();
  expect_same_bits(a, again.solve());
  for (const auto& [id, node] : a.nodes) {
    EXPECT_LT(distance(node.T_world_node, b.nodes.at(id).T_world_node), 1e-9) << id;
    EXPECT_NEAR(node.log_scale_sigma, b.nodes.at(id).log_scale_sigma, 1e-9) << id;
  }
}

// Independent: dense, numeric derivatives, left perturbations.
std::vector<SE3> gauss_newton_se3(const SmallGraph& g) {
  std::vector<SE3> T = {SE3()};
  for (const auto& [id, guess] : g.guesses) T.push_back(guess.rigid);
  const auto index = [](NodeId id) { return id == NodeId::world() ? 0 : id.number() + 1; };
  const auto n = static_cast<Eigen::Index>(g.guesses.size());
  for (int step = 0; step < 30; ++step) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * n + 6, 6 * n + 6);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(6 * n + 6);
    for (const Constraint& c : g.constraints) {
      const int i = index(c.from), j = index(c.to);
      const auto of = [&](const SE3& a, const SE3& z) -> Vector6d {
        return (a.inverse() * z * c.T_from_to.rigid.inverse()).log();
      };
      const Matrix6d omega = c.covariance.topLeftCorner<6, 6>().inverse();
      Eigen::Matrix<double, 6, 12> J;
      J << test::numerical_jacobian<6>([&](const Vector6d& d) { return of(SE3::exp(d) * T[i], T[j]); }),
          test::numerical_jacobian<6>([&](const Vector6d& d) { return of(T[i], SE3::exp(d) * T[j]); });
      const Eigen::Matrix<double, 12, 12> JJ = J.transpose() * omega * J;
      const Eigen::Matrix<double, 12, 1> Jr = J.transpose() * omega * of(T[i], T[j]);
      const int at[] = {6 * i, 6 * j};
      for (int p = 0; p < 2; ++p) {
        b.segment<6>(at[p]) += Jr.segment<6>(6 * p);
        for (int q = 0; q < 2; ++q) H.block<6, 6>(at[p], at[q]) += JJ.block<6, 6>(6 * p, 6 * q);
      }
    }
    const Eigen::VectorXd d = H.bottomRightCorner(6 * n, 6 * n).ldlt().solve(b.tail(6 * n));
    for (Eigen::Index k = 0; k < n; ++k) T[k + 1] = SE3::exp(-d.segment<6>(6 * k)) * T[k + 1];
  }
  return T;
}

TEST(MapGraph, WithExactScalesIsAPoseGraphOnSE3) {
  Random random(5);
  SmallGraph g = small_graph(4, covariance_of(0.05, 0.02, 0), random);
  for (Constraint& c : g.constraints) c.T_from_to.scale = 1;
  MapGraph graph;
  fill(g, &graph);
  const GraphSolution s = graph.solve();
  const std::vector<SE3> expected = gauss_newton_se3(g);
  for (int i = 0; i < 4; ++i) {
    const NodeSolution& node = s.nodes.at(NodeId::keyframe(i));
    EXPECT_EQ(node.T_world_node.scale, 1);
    EXPECT_EQ(node.log_scale_sigma, 0);
    EXPECT_THAT(node.T_world_node.rigid, test::SE3Near(expected[i + 1], 1e-9, 1e-9));
  }
}

// A keyframe in the unit of its epoch has its scale, whatever it is, and is as uncertain.
TEST(MapGraph, ExactScalesAreShared) {
  MapGraph graph;
  add_epochs(&graph);
  graph.add(scale_constraint(kA, kB, 2, 0.1, ConstraintKind::kFeatures));
  const NodeId k = NodeId::keyframe(7);
  graph.add_node(k, Sim3());
  Constraint rigid;
  rigid.from = kB, rigid.to = k;
  rigid.T_from_to = {0.5, SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(3, 0, 0))};
  rigid.covariance = covariance_of(0.01, 0.01, 0);
  graph.add(rigid);
  const GraphSolution s = graph.solve();
  EXPECT_NEAR(scale_of(s, k), 1, 1e-12);
  EXPECT_EQ(sigma_of(s, k), sigma_of(s, kB));
  EXPECT_NEAR(s.nodes.at(k).T_world_node.rigid.translation().x(), 6, 1e-9);
}

TEST(MapGraph, WhatNothingTiesToTheWorldKeepsItsGuess) {
  Random random(6);
  MapGraph graph;
  add_epochs(&graph);
  const Sim3 guess = some_place(random);
  const NodeId first = NodeId::keyframe(1), second = NodeId::keyframe(2);
  graph.add_node(first, guess), graph.add_node(second, Sim3());
  Constraint c;
  c.from = second, c.to = first, c.T_from_to = some_place(random),
  c.covariance = covariance_of(0.1, 0.1, 0.1);
  graph.add(c);
  const GraphSolution s = graph.solve();
  EXPECT_LT(distance(s.nodes.at(first).T_world_node, guess), 1e-15);
  EXPECT_LT(distance(s.nodes.at(second).T_world_node * c.T_from_to, guess), 1e-9);
  for (const NodeId id : {first, second, kB}) EXPECT_EQ(sigma_of(s, id), kUnmeasured) << id;
  EXPECT_EQ(distance(s.nodes.at(kB).T_world_node, Sim3()), 0);
}

// Both camera positions are measured from the world, and from the first camera: that gives its unit.
TEST(MapGraph, ScaleFollowsFromPositionsWhereTheyFixIt) {
  MapGraph graph;
  const NodeId a = NodeId::keyframe(1), b = NodeId::keyframe(2), c = NodeId::keyframe(3);
  for (const NodeId id : {a, b, c}) graph.add_node(id, Sim3());
  const auto place = [&](NodeId from, NodeId to, double x) {
    Constraint p;
    p.from = from, p.to = to, p.kind = ConstraintKind::kMetric;
    p.T_from_to.rigid = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0));
    p.covariance = covariance_of(1e-3, 1e-3, kUnmeasured);
    p.centre = p.T_from_to.rigid.translation();
    graph.add(p);
  };
  place(NodeId::world(), a, 10), place(NodeId::world(), b, 14), place(a, b, 1), place(a, c, 2);
  const GraphSolution s = graph.solve();
  EXPECT_NEAR(scale_of(s, a), 4, 1e-6);
  EXPECT_NEAR(sigma_of(s, a), 1e-3 * std::sqrt(2.0 / 16 + 1), 1e-5);
  EXPECT_NEAR(s.nodes.at(c).T_world_node.rigid.translation().x(), 18, 1e-6);
  EXPECT_EQ(sigma_of(s, b), kUnmeasured);
  EXPECT_EQ(sigma_of(s, c), kUnmeasured);
  EXPECT_NEAR(scale_of(s, b), 1, 1e-6);
}

TEST(MapGraph, SigmasAreThoseRequested) {
  MapGraph graph;
  add_epochs(&graph);
  graph.add(scale_constraint(kA, kB, 1, 0.1, ConstraintKind::kFeatures));
  graph.add_node(NodeId::keyframe(1), Sim3());
  graph.add(scale_constraint(kB, NodeId::keyframe(1), 1, 0.1, ConstraintKind::kFeatures));
  EXPECT_TRUE(std::isnan(sigma_of(graph.solve(MapGraph::Sigmas::kNone), kB)));
  const GraphSolution s = graph.solve(MapGraph::Sigmas::kEpochs);
  EXPECT_NEAR(sigma_of(s, kB), 0.1, 1e-9);
  EXPECT_TRUE(std::isnan(sigma_of(s, NodeId::keyframe(1))));
}

TEST(MapGraph, SolvesWithoutConstraints) {
  MapGraph graph;
  EXPECT_EQ(graph.solve().nodes.size(), 1u);
  graph.add_node(kA, Sim3{2, SE3()});
  EXPECT_EQ(scale_of(graph.solve(), kA), 2);
}

TEST(MapGraph, ThreeThreadsAddAtOnce) {
  MapGraph graph;
  constexpr int kEach = 100;
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&graph, t] {
      for (int i = 0; i < kEach; ++i) {
        const NodeId id = NodeId::epoch(t, i);
        graph.add_node(id, Sim3());
        graph.add(scale_constraint(NodeId::world(), id, 1 + i, 0.1, ConstraintKind::kOperator));
        if (i % 50 == 0) graph.solve(MapGraph::Sigmas::kNone);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(graph.constraints().size(), 3u * kEach);
  const GraphSolution s = graph.solve(MapGraph::Sigmas::kNone);
  for (int t = 0; t < 3; ++t)
    for (int i = 0; i < kEach; ++i) EXPECT_NEAR(scale_of(s, NodeId::epoch(t, i)), 1 + i, 1e-9 * (1 + i));
}

}  // namespace
}  // namespace edgevo
