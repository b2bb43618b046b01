// SPDX-License-Identifier: BSD-3-Clause
// Marginal standard deviations of the scales, from a sparse factorisation of the normal equations.
#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>

#include "graph_solver.h"

namespace edgevo {
namespace {

// A second factorisation with so many times as much extrapolates to none.
constexpr double kMore = 10;
// A variance that depends on the regularisation by more than this factor is that of a free direction.
constexpr double kFreeRatio = 2;
// Information below which a direction counts as not measured: units or radians to the power -2.
constexpr double kNoInformation = 1e-12;

class ScaleVariances {
 public:
  explicit ScaleVariances(const GraphState& state)
      : state_(state), pose_(state.ids.size(), -1), scale_(state.ids.size(), -1) {
    for (size_t i = 0; i < state.ids.size(); ++i) {
      if (!state.pose_fixed[i]) pose_[i] = size_, size_ += 6;
      if (state.root[i] == static_cast<int>(i) && !state.scale_fixed[i]) scale_[i] = size_++;
    }
    assemble();
    scale_to_unit_diagonal();
    factorise();
  }

  // Variance of the log scale of a root whose scale is free.
  double variance(int root) const {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(size_, scale_[root]);
    const double v = little_.solve(unit)[scale_[root]], less = more_.solve(unit)[scale_[root]];
    if (!(v > 0) || (!state_.scale_tied[root] && v > kFreeRatio * less))
      return std::numeric_limits<double>::infinity();
    return (v + (v - less) / (kMore - 1)) * std::pow(inv_diagonal_[scale_[root]], 2);
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  void assemble();
  void add(const GraphTerm& term, std::vector<Eigen::Triplet<double>>* lower) const;
  void scale_to_unit_diagonal();
  void factorise();

  const GraphState& state_;
  std::vector<int> pose_, scale_;
  int size_ = 0;
  Matrix H_;
  Eigen::VectorXd inv_diagonal_;
  Eigen::SimplicialLDLT<Matrix> little_, more_;
};

// J' J of a term: its columns belong to two poses and one or two scales.
void ScaleVariances::add(const GraphTerm& term, std::vector<Eigen::Triplet<double>>* lower) const {
  const GraphResidual lin = graph_residual(term.constraint, state_.node(term.from), state_.node(term.to));
  const auto& W = term.modes[term.mode].whitening;
  Eigen::Matrix<double, Eigen::Dynamic, 14, 0, 7, 14> J(W.rows(), 14);
  J << W * lin.J_from, W * lin.J_to;
  int index[14];
  for (int k = 0; k < 6; ++k) {
    index[k] = pose_[term.from] < 0 ? -1 : pose_[term.from] + k;
    index[7 + k] = pose_[term.to] < 0 ? -1 : pose_[term.to] + k;
  }
  index[6] = scale_[state_.root[term.from]];
  index[13] = scale_[state_.root[term.to]];
  if (index[6] == index[13]) J.col(6) += J.col(13), index[13] = -1;
  const Eigen::Matrix<double, 14, 14> JJ = J.transpose() * J;
  for (int a = 0; a < 14; ++a)
    for (int b = 0; b < 14; ++b)
      if (index[b] >= 0 && index[a] >= index[b]) lower->emplace_back(index[a], index[b], JJ(a, b));
}

void ScaleVariances::assemble() {
  std::vector<Eigen::Triplet<double>> lower;
  for (int k = 0; k < size_; ++k) lower.emplace_back(k, k, 0.0);
  for (const GraphTerm& term : state_.terms) add(term, &lower);
  H_.resize(size_, size_);
  H_.setFromTriplets(lower.begin(), lower.end());
}

void ScaleVariances::scale_to_unit_diagonal() {
  inv_diagonal_ = H_.diagonal().cwiseMax(kNoInformation).cwiseSqrt().cwiseInverse();
  H_ = (inv_diagonal_.asDiagonal() * H_ * inv_diagonal_.asDiagonal()).eval();
}

void ScaleVariances::factorise() {
  little_.setShift(kGraphRegularisation);
  little_.compute(H_);
  more_.setShift(kMore * kGraphRegularisation);
  more_.compute(H_);
}

}  // namespace

std::vector<double> graph_sigmas(const GraphState& state, MapGraph::Sigmas which) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const size_t n = state.ids.size();
  std::vector<double> sigmas(n, kNaN), of_root(n, kNaN);
  std::optional<ScaleVariances> variances;
  for (size_t i = 0; i < n; ++i) {
    const int root = state.root[i];
    if (root == 0) {
      sigmas[i] = 0;
    } else if (!state.tied[i]) {
      sigmas[i] = std::numeric_limits<double>::infinity();
    } else if (which == MapGraph::Sigmas::kAll ||
               (which == MapGraph::Sigmas::kEpochs && state.ids[i].kind() == NodeId::Kind::kEpoch)) {
      if (!variances) variances.emplace(state);
      if (std::isnan(of_root[root])) of_root[root] = std::sqrt(variances->variance(root));
      sigmas[i] = of_root[root];
    }
  }
  return sigmas;
}

}  // namespace edgevo
