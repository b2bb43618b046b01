// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/map_graph.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <mutex>
#include <ostream>
#include <stdexcept>
#include <tuple>

#include "edgevo/core/formatted.h"
#include "graph_residual.h"
#include "graph_solver.h"
#include "scale_groups.h"

namespace edgevo {
namespace {

// Difference of two logarithms of exact scales that is rounding, not a contradiction.
constexpr double kExactTolerance = 1e-9;
// Asymmetry of a covariance relative to its diagonal that is rounding.
constexpr double kAsymmetry = 1e-9;

const char* const kDirections[] = {"v.x", "v.y", "v.z", "w.x", "w.y", "w.z", "sigma"};

[[noreturn]] void refuse(const std::string& subject, const std::string& what) {
  throw std::invalid_argument(subject + ": " + what);
}

std::string subject_of(const Constraint& c) {
  return "constraint " + to_string(c.from) + " -> " + to_string(c.to) + " (" + to_string(c.kind) + ")";
}

void check_similarity(const std::string& subject, const Sim3& T) {
  if (!T.rigid.is_finite() || !std::isfinite(T.scale)) refuse(subject, "a value is not finite");
  if (T.scale <= 0) refuse(subject, formatted("scale %g is not positive", T.scale));
}

void check_guess(NodeId id, const Sim3& T) { check_similarity("node " + to_string(id), T); }

// A direction that is not measured, or exact, has no correlations.
void check_alone(const std::string& subject, const Matrix7d& covariance, int k) {
  for (int j = 0; j < 7; ++j)
    if (j != k && (covariance(k, j) != 0 || covariance(j, k) != 0))
      refuse(subject, formatted("row and column of %s must be 0, as its variance is %g", kDirections[k],
                                covariance(k, k)));
}

void check_symmetry(const std::string& subject, const Matrix7d& covariance) {
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < i; ++j) {
      const double a = covariance(i, j), b = covariance(j, i);
      if (std::isnan(a) || std::isnan(b)) refuse(subject, "a value is NaN");
      if (!std::isfinite(a) || !std::isfinite(b))
        refuse(subject, "a covariance of two directions is infinite");
      const double size = std::sqrt(std::abs(covariance(i, i) * covariance(j, j)));
      if (std::abs(a - b) > kAsymmetry * std::max(size, std::abs(a)))
        refuse(subject,
               formatted("not symmetric: %g and %g of %s and %s", a, b, kDirections[i], kDirections[j]));
    }
}

void check_covariance(const std::string& subject, const Matrix7d& covariance) {
  bool measures = false;
  Matrix7d measured = covariance;
  for (int k = 0; k < 7; ++k) {
    const double variance = covariance(k, k);
    if (std::isnan(variance)) refuse(subject, "a value is NaN");
    if (variance < 0)
      refuse(subject, formatted("variance %g of %s is not positive", variance, kDirections[k]));
    if (std::isfinite(variance)) measures = true;
    if (std::isinf(variance) || (k == 6 && variance == 0)) {
      check_alone(subject, covariance, k);
      measured(k, k) = 1;
    }
  }
  check_symmetry(subject, covariance);
  if (!measures) refuse(subject, "nothing is measured");
  if (Eigen::LLT<Matrix7d>(measured).info() != Eigen::Success)
    refuse(subject, "not positive definite in the directions measured");
}

void check_failure(const std::string& subject, const Constraint& c) {
  const Constraint::Failure& failure = *c.failure;
  if (!(failure.probability >= 0 && failure.probability < 1))
    refuse(subject, formatted("probability %g of failure is not in [0, 1)", failure.probability));
  check_covariance(subject + ", covariance of the failure", failure.covariance);
  for (int k = 0; k < 7; ++k) {
    const double first = c.covariance(k, k), failed = failure.covariance(k, k);
    if (std::isinf(first) != std::isinf(failed) || (first == 0) != (failed == 0))
      refuse(subject,
             formatted("%s has variance %g, and %g in the failure: both or neither are measured or exact",
                       kDirections[k], first, failed));
  }
  Constraint even = c;
  even.failure->probability = 0.5;
  const std::vector<GraphMode> modes = graph_modes(even);
  if (modes[1].normalisation < modes[0].normalisation)
    refuse(subject, "the covariance of the failure is smaller than that without");
}

}  // namespace

bool NodeId::operator<(const NodeId& other) const {
  return std::tie(kind_, number_, epoch_) < std::tie(other.kind_, other.number_, other.epoch_);
}

std::string to_string(const NodeId& id) {
  switch (id.kind()) {
    case NodeId::Kind::kWorld:
      return "world";
    case NodeId::Kind::kEpoch:
      return formatted("epoch %d/%d", id.number(), id.epoch());
    case NodeId::Kind::kKeyframe:
      break;
  }
  return formatted("keyframe %d", id.number());
}

std::ostream& operator<<(std::ostream& out, const NodeId& id) { return out << to_string(id); }

std::string to_string(ConstraintKind kind) {
  switch (kind) {
    case ConstraintKind::kNeighbour:
      return "neighbour";
    case ConstraintKind::kContinuity:
      return "continuity";
    case ConstraintKind::kSpeed:
      return "speed";
    case ConstraintKind::kDepthRatio:
      return "depth ratio";
    case ConstraintKind::kStandstill:
      return "standstill";
    case ConstraintKind::kFeatures:
      return "features";
    case ConstraintKind::kGround:
      return "ground";
    case ConstraintKind::kMetric:
      return "metric";
    case ConstraintKind::kPlace:
      return "place";
    case ConstraintKind::kOperator:
      break;
  }
  return "operator";
}

Matrix7d covariance_of_scale(double sigma) {
  Vector7d variances = Vector7d::Constant(std::numeric_limits<double>::infinity());
  variances[6] = sigma * sigma;
  Matrix7d covariance = Matrix7d::Zero();
  covariance.diagonal() = variances;
  return covariance;
}

Constraint scale_constraint(ConstraintKind kind, NodeId from, NodeId to, double scale, double sigma) {
  Constraint c;
  c.from = from, c.to = to;
  c.T_from_to.scale = scale;
  c.covariance = covariance_of_scale(sigma);
  c.kind = kind;
  return c;
}

void check_constraint(const Constraint& c) {
  const std::string subject = subject_of(c);
  if (c.from == c.to) refuse(subject, "both ends are one node");
  check_similarity(subject, c.T_from_to);
  if (!c.centre.allFinite()) refuse(subject, "the centre is not finite");
  check_covariance(subject + ", covariance", c.covariance);
  if (c.failure) check_failure(subject, c);
}

struct MapGraph::Impl {
  mutable std::mutex mutex;
  std::map<NodeId, Sim3> nodes = {{NodeId::world(), Sim3()}};
  std::map<int, Constraint> constraints;
  ScaleGroups exact;
  int next_id = 0;

  void check(const Constraint& c) const {
    const std::string subject = subject_of(c);
    for (const NodeId id : {c.from, c.to})
      if (!nodes.count(id)) refuse(subject, "node " + to_string(id) + " is not known");
    check_constraint(c);
    if (!has_exact_scale(c)) return;
    const std::optional<double> known = exact.between(c.from, c.to);
    if (known && std::abs(*known - std::log(c.T_from_to.scale)) > kExactTolerance)
      refuse(subject, formatted("exact scale %g contradicts %g from other exact scales", c.T_from_to.scale,
                                std::exp(*known)));
  }
  void note_exact(const Constraint& c) {
    if (has_exact_scale(c)) exact.tie(c.from, c.to, std::log(c.T_from_to.scale));
  }
};

MapGraph::MapGraph() : impl_(std::make_unique<Impl>()) {}
MapGraph::~MapGraph() = default;

void MapGraph::add_node(NodeId id, const Sim3& T_world_node_guess) {
  check_guess(id, T_world_node_guess);
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  if (!impl_->nodes.emplace(id, T_world_node_guess).second)
    refuse("node " + to_string(id), "there is one already");
}

void MapGraph::set_guess(NodeId id, const Sim3& T_world_node_guess) {
  check_guess(id, T_world_node_guess);
  if (id == NodeId::world()) refuse("node world", "it is fixed");
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  const auto node = impl_->nodes.find(id);
  if (node == impl_->nodes.end()) refuse("node " + to_string(id), "it is not known");
  node->second = T_world_node_guess;
}

int MapGraph::add(const Constraint& constraint) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->check(constraint);
  impl_->constraints.emplace(impl_->next_id, constraint);
  impl_->note_exact(constraint);
  return impl_->next_id++;
}

void MapGraph::withdraw(int id) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  const auto found = impl_->constraints.find(id);
  if (found == impl_->constraints.end()) refuse(formatted("constraint %d", id), "there is none with this id");
  const bool rebuild = has_exact_scale(found->second);
  impl_->constraints.erase(found);
  if (!rebuild) return;
  impl_->exact = ScaleGroups();
  for (const auto& [other, c] : impl_->constraints) impl_->note_exact(c);
}

bool MapGraph::knows(NodeId id) const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return impl_->nodes.count(id) > 0;
}

std::map<NodeId, Sim3> MapGraph::nodes() const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return impl_->nodes;
}

std::map<int, Constraint> MapGraph::constraints() const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return impl_->constraints;
}

GraphSolution MapGraph::solve(Sigmas sigmas) const {
  std::unique_lock<std::mutex> lock(impl_->mutex);
  GraphState state(impl_->nodes, impl_->constraints);
  lock.unlock();
  GraphSolution solution;
  minimise_graph(&state, &solution);
  const std::vector<double> sigma = graph_sigmas(state, sigmas);
  for (size_t i = 0; i < state.ids.size(); ++i)
    solution.nodes[state.ids[i]] = {state.node(static_cast<int>(i)), sigma[i]};
  return solution;
}

}  // namespace edgevo
