// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Constraints and graphs of known truth, for tests and benchmarks of map/map_graph.h.
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "edgevo/core/random.h"
#include "edgevo/map/map_graph.h"

namespace edgevo::test {

constexpr double kUnmeasured = std::numeric_limits<double>::infinity();

/// Independent standard deviations: of the translation, the rotation and the logarithm of the scale.
inline Matrix7d covariance_of(double sigma_v, double sigma_w, double sigma_scale) {
  Vector7d sigma;
  sigma << Eigen::Vector3d::Constant(sigma_v), Eigen::Vector3d::Constant(sigma_w), sigma_scale;
  return sigma.cwiseAbs2().asDiagonal();
}

/// A constraint on the scale alone: `scale` is a unit of `to` over one of `from`.
inline Constraint scale_constraint(NodeId from, NodeId to, double scale, double sigma, ConstraintKind kind) {
  Constraint c;
  c.from = from, c.to = to, c.kind = kind;
  c.T_from_to.scale = scale;
  c.covariance = covariance_of(kUnmeasured, kUnmeasured, sigma);
  return c;
}

/// Standard normal tangent.
inline Vector7d normal_tangent(Random& random) {
  Vector7d xi;
  for (double& x : xi) x = random.normal();
  return xi;
}

/// A constraint as measured with noise of its covariance, which is diagonal: what is unmeasured or exact gets
/// none.
inline Constraint noisy_constraint(NodeId from, NodeId to, const Sim3& T_from_to, const Matrix7d& covariance,
                                   ConstraintKind kind, Random& random) {
  Vector7d xi = normal_tangent(random);
  for (int k = 0; k < 7; ++k) xi[k] *= std::isinf(covariance(k, k)) ? 0 : std::sqrt(covariance(k, k));
  Constraint c;
  c.from = from, c.to = to, c.kind = kind, c.covariance = covariance;
  c.T_from_to = Sim3::exp(xi) * T_from_to;
  return c;
}

/// A drive through a town: true nodes, guesses that drift, and constraints.
struct GraphScene {
  std::vector<Sim3> truth, guess;
  std::vector<Constraint> constraints;
};

/// What a scene has.
struct GraphSceneOptions {
  int keyframes = 10000;
  int constraints = 60000;
  /// Probability that a place is mistaken; with it places can fail.
  double mistaken = 0;
};

/// The true drive: 2 m between keyframes, at random through streets with crossings every 100 m in a square of
/// 8 x 8 blocks; units of length that vary slowly by 10 %.
inline std::vector<Sim3> drive_through_town(int keyframes, Random& random) {
  constexpr double kStep_m = 2;
  constexpr int kPerBlock = 50, kBlocks = 8;
  const int dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};
  std::vector<Sim3> truth;
  int x = 0, y = 0, heading = 0;
  for (int i = 0; i < keyframes; ++i) {
    if (i % kPerBlock == 0) {
      const int from = heading;
      do heading = random.below(4);
      while (heading == (from + 2) % 4 || x + dx[heading] < 0 || x + dx[heading] > kBlocks ||
             y + dy[heading] < 0 || y + dy[heading] > kBlocks);
    }
    const double along = (i % kPerBlock) / double(kPerBlock), block_m = kStep_m * kPerBlock;
    const Eigen::Vector3d t(block_m * (x + along * dx[heading]), block_m * (y + along * dy[heading]), 0);
    const Eigen::AngleAxisd turn(M_PI / 2 * heading, Eigen::Vector3d::UnitZ());
    truth.push_back({std::exp(0.1 * std::sin(i / 500.0)), SE3(Eigen::Quaterniond(turn), t)});
    if (i % kPerBlock == kPerBlock - 1) x += dx[heading], y += dy[heading];
  }
  return truth;
}

/// Pairs of keyframes that see the same place on different occasions: 30 or more apart in the drive, within
/// the same square of 10 m.
inline std::vector<std::pair<int, int>> places_of(const std::vector<Sim3>& truth, size_t most) {
  std::map<std::pair<int, int>, std::vector<int>> cells;
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
    const Eigen::Vector3d& t = truth[i].rigid.translation();
    std::vector<int>& cell = cells[{int(std::floor(t.x() / 10)), int(std::floor(t.y() / 10))}];
    for (const int j : cell)
      if (i - j >= 30) pairs.emplace_back(j, i);
    cell.push_back(i);
  }
  std::vector<std::pair<int, int>> chosen;
  const size_t n = std::min(most, pairs.size());
  for (size_t k = 0; k < n; ++k) chosen.push_back(pairs[k * pairs.size() / n]);
  return chosen;
}

/// A scene: the first keyframe is known in the world, half of the constraints are of neighbours up to three
/// apart, the rest are places.
inline GraphScene make_graph_scene(const GraphSceneOptions& o, uint64_t seed) {
  Random random(seed);
  GraphScene scene;
  scene.truth = drive_through_town(o.keyframes, random);
  const auto measure = [&](int i, int j, const Matrix7d& covariance, ConstraintKind kind) {
    const Sim3 T = scene.truth[i].inverse() * scene.truth[j];
    scene.constraints.push_back(
        noisy_constraint(NodeId::keyframe(i), NodeId::keyframe(j), T, covariance, kind, random));
  };
  scene.constraints.push_back(noisy_constraint(NodeId::world(), NodeId::keyframe(0), scene.truth[0],
                                               covariance_of(1e-3, 1e-4, 1e-3), ConstraintKind::kMetric,
                                               random));
  scene.guess = {scene.constraints[0].T_from_to};
  for (int i = 1; i < o.keyframes; ++i) {
    measure(i - 1, i, covariance_of(0.01, 1e-3, 1e-3), ConstraintKind::kNeighbour);
    scene.guess.push_back(scene.guess.back() * scene.constraints.back().T_from_to);
    for (int apart = 2; apart <= 3 && apart <= i; ++apart)
      measure(i - apart, i, covariance_of(0.01 * apart, 1e-3 * apart, 1e-3 * apart),
              ConstraintKind::kNeighbour);
  }
  for (const auto& [i, j] : places_of(scene.truth, o.constraints - scene.constraints.size())) {
    measure(i, j, covariance_of(0.05, 5e-3, 1e-2), ConstraintKind::kPlace);
    if (o.mistaken <= 0) continue;
    Constraint& place = scene.constraints.back();
    place.failure = {o.mistaken, covariance_of(100, 1, 1)};
    if (random.uniform() < o.mistaken)
      place.T_from_to =
          Sim3::exp(covariance_of(30, 0.3, 0.3).cwiseSqrt() * normal_tangent(random)) * place.T_from_to;
  }
  return scene;
}

/// Puts a scene into a graph.
inline void fill_graph(const GraphScene& scene, MapGraph* graph) {
  for (size_t i = 0; i < scene.guess.size(); ++i)
    graph->add_node(NodeId::keyframe(static_cast<int>(i)), scene.guess[i]);
  for (const Constraint& c : scene.constraints) graph->add(c);
}

}  // namespace edgevo::test
