// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The residual of a constraint, its derivatives, and its modes.
#include <Eigen/Core>
#include <vector>

#include "edgevo/map/map_graph.h"

namespace edgevo {

/// xi of predicted = exp(xi) measured, about the centre of the constraint, and its derivatives by
/// perturbations of the nodes from the RIGHT, T <- T exp(delta): they depend on nothing but the relative
/// pose, however far from the origin of the world the nodes are.
struct GraphResidual {
  /// [v, w, sigma].
  Vector7d xi;
  /// d xi / d delta of either node.
  Matrix7d J_from, J_to;
};

/// r of D = C^-1 P M^-1 C with P = T_world_from^-1 T_world_to, M as measured, C the translation to the
/// centre: log(D) where all is measured; else translation, logarithm of the rotation and of the scale of D.
GraphResidual graph_residual(const Constraint& constraint, const Sim3& T_world_from, const Sim3& T_world_to);
/// r alone.
Vector7d graph_error(const Constraint& constraint, const Sim3& T_world_from, const Sim3& T_world_to);

/// Whether the scale of a constraint is exact, and whether a direction (index of xi) is measured.
bool has_exact_scale(const Constraint& constraint);
bool is_measured(const Constraint& constraint, int direction);

/// One mode of a constraint, ready to be evaluated.
struct GraphMode {
  /// (directions with a finite, nonzero variance) x 7: its product with xi has covariance I.
  Eigen::Matrix<double, Eigen::Dynamic, 7, 0, 7, 7> whitening;
  /// ln det Sigma - 2 ln w.
  double normalisation = 0;
};

/// The first mode, and that of the failure, if there is one. An empty `whitening`: nothing to evaluate.
std::vector<GraphMode> graph_modes(const Constraint& constraint);

}  // namespace edgevo
