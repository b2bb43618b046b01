// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the parts of a monocular map relate, and how certain that is: one graph owns every length, segment and
// place.
//
// A node is a frame with a unit of length of its own, at T_world_node of Sim(3) in the world. A constraint is
// a measured similarity of two nodes with its covariance; what it does not measure is left free. The solution
// minimises
//     sum over the constraints of min over their modes of  r' Sigma^-1 r + ln det Sigma - 2 ln w
// with the residual r of graph_residual.h; a constraint that can fail has two modes with probabilities w, a
// max-mixture (Olson and Agarwal, "Inference on networks of mixtures for robust robot mapping", 2013).
//
// Gauge. The world is fixed. Where no constraint ties a group of nodes to the world, its first node keeps its
// guess and the others follow what ties them to it. A direction of a node that no constraint measures stays
// where the guess is. What several nodes have in common and no constraint measures, such as their unit where
// only poses tie them to the world, follows the guess only roughly: the solution is one of many of equal
// cost.
#include <Eigen/Core>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/sim3.h"

namespace edgevo {

/// Names a node of the graph. Ordered: the world, the epochs, the keyframes.
class NodeId {
 public:
  /// What a node stands for.
  enum class Kind : uint8_t { kWorld, kEpoch, kKeyframe };

  /// The world: its unit is the metre where that is known.
  static NodeId world() { return {}; }
  /// The map of a segment in an epoch: an interval within which its unit of length is one.
  static NodeId epoch(int segment, int epoch) { return {Kind::kEpoch, segment, epoch}; }
  /// A marginalised keyframe: its camera frame, in its own unit.
  static NodeId keyframe(int id) { return {Kind::kKeyframe, id, 0}; }

  /// What it stands for.
  Kind kind() const { return kind_; }
  /// Segment of an epoch, id of a keyframe.
  int number() const { return number_; }
  /// Number of an epoch within its segment.
  int epoch() const { return epoch_; }

  /// Same node.
  bool operator==(const NodeId& other) const { return !(*this < other) && !(other < *this); }
  /// Another node.
  bool operator!=(const NodeId& other) const { return !(*this == other); }
  /// Order of the nodes.
  bool operator<(const NodeId& other) const;

 private:
  NodeId() = default;
  NodeId(Kind kind, int number, int epoch) : kind_(kind), number_(number), epoch_(epoch) {}

  Kind kind_ = Kind::kWorld;
  int number_ = 0, epoch_ = 0;
};

/// "world", "epoch 2/0" (segment 2) or "keyframe 17".
std::string to_string(const NodeId& id);
/// Prints to_string().
std::ostream& operator<<(std::ostream& out, const NodeId& id);

/// What a constraint was measured from.
enum class ConstraintKind {
  kNeighbour,   ///< Keyframes of one window.
  kContinuity,  ///< The camera moves on across a break.
  kSpeed,       ///< The speed stays what it was.
  kDepthRatio,  ///< Depths of what both show.
  kStandstill,  ///< The vehicle stands.
  kFeatures,    ///< Point features that both show.
  kGround,      ///< Height of the camera above the ground.
  kMetric,      ///< A sensor that measures metres.
  kPlace,       ///< A place recognised.
  kOperator     ///< Given by a person.
};

/// Its name in messages: "neighbour", "continuity", ...
std::string to_string(ConstraintKind kind);

/// A measured similarity of two nodes: T_from_to <- exp(xi) T_from_to with xi of covariance `covariance`.
/// Where a direction is not measured, T_from_to is scaled by exp(sigma), then turned by w, then moved by v:
/// the same to first order, but v does not depend on what is free.
struct Constraint {
  /// The nodes.
  NodeId from = NodeId::world(), to = NodeId::world();
  /// Measured: coordinates of `to` to coordinates of `from`; its scale is a unit of `to` over one of `from`.
  Sim3 T_from_to;
  /// Covariance of xi = [v, w, sigma], in units of `from`, radians and logarithm of the scale. A diagonal
  /// entry of +infinity, its row and column 0 otherwise: not measured. Row and column of sigma 0: the scale
  /// is exact, a rigid constraint.
  Matrix7d covariance = Matrix7d::Identity();
  /// What it was measured from.
  ConstraintKind kind = ConstraintKind::kNeighbour;

  /// What else may hold.
  struct Failure {
    /// Probability that the constraint has failed, in [0, 1).
    double probability = 0;
    /// Its covariance then: the same directions measured or exact, and a larger determinant.
    Matrix7d covariance = Matrix7d::Identity();
  };
  /// Set for a constraint that can fail: a unit that changed, wheels that slip, a place that is mistaken.
  std::optional<Failure> failure;

  /// Point of `from` that xi turns and scales about. With 0 an unknown scale also moves the origin of `to`
  /// along its direction; with the translation of T_from_to it does not.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// Covariance of a measurement of the scale alone, with a standard deviation of its logarithm.
Matrix7d covariance_of_scale(double sigma);
/// A measurement of the scale alone: a unit of `to` over one of `from`, and the standard deviation of its
/// logarithm.
Constraint scale_constraint(ConstraintKind kind, NodeId from, NodeId to, double scale, double sigma);

/// Throws std::invalid_argument if both nodes are one, if a value is NaN or the scale not positive, if a
/// covariance is not symmetric and positive definite in the directions measured, or if the failure has
/// another pattern of measured directions, a smaller determinant or a probability outside [0, 1).
void check_constraint(const Constraint& constraint);

/// A node in the solution.
struct NodeSolution {
  /// Coordinates of the node to the world.
  Sim3 T_world_node;
  /// Standard deviation of the logarithm of its scale relative to the world, all else free and every
  /// constraint in its mode; 0 where it is exact, infinity where nothing fixes it, NaN where not requested.
  double log_scale_sigma = 0;
};

/// What solve() found.
struct GraphSolution {
  /// All nodes, the world included.
  std::map<NodeId, NodeSolution> nodes;
  /// Ids of the constraints that hold in their failure mode, ascending.
  std::vector<int> failed;
  /// Sum of r' Sigma^-1 r, and for each failed constraint of what its mode costs: the change of ln det Sigma
  /// - 2 ln w from the first mode.
  double cost = 0;
  /// Steps of the minimisation, all choices of modes together.
  int iterations = 0;
  /// Whether the minimisation converged. If not, the best found.
  bool converged = true;
};

/// The graph. Safe in any thread, with any number of producers.
class MapGraph {
 public:
  /// With the world, at the identity and fixed.
  MapGraph();
  ~MapGraph();
  MapGraph(const MapGraph&) = delete;
  MapGraph& operator=(const MapGraph&) = delete;

  /// Adds a node. Throws std::invalid_argument, and changes nothing, if it is there already, or if the guess
  /// is not finite or its scale not positive.
  void add_node(NodeId id, const Sim3& T_world_node_guess);
  /// Replaces the guess of a node, which solve() starts from. Throws as add_node(), and for an unknown node
  /// or the world.
  void set_guess(NodeId id, const Sim3& T_world_node_guess);

  /// Adds a constraint and returns its id; ids ascend from 0. Throws std::invalid_argument, and changes
  /// nothing, if a node is not known, as check_constraint(), or if an exact scale contradicts other exact
  /// ones.
  int add(const Constraint& constraint);
  /// Removes a constraint. Throws std::invalid_argument if there is none with this id.
  void withdraw(int id);

  /// Whether there is such a node.
  bool knows(NodeId id) const;
  /// Nodes with their guesses.
  std::map<NodeId, Sim3> nodes() const;
  /// Constraints by their ids.
  std::map<int, Constraint> constraints() const;

  /// Which nodes get a log_scale_sigma. Each scale costs a triangular solve: in a graph of 10,000 keyframes
  /// with scales of their own all of them take minutes.
  enum class Sigmas { kNone, kEpochs, kAll };
  /// The most probable nodes and modes. The same calls in the same order give the same bits.
  GraphSolution solve(Sigmas sigmas = Sigmas::kAll) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
