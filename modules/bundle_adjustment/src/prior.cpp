// SPDX-License-Identifier: BSD-3-Clause
#include "prior.h"

#include <Eigen/LU>
#include <algorithm>

namespace edgevo::ba {
namespace {

// ad(xi) x = [xi, x], the bracket of se(3).
Matrix6d bracket(const Vector6d& xi) {
  const Eigen::Matrix3d W = skew(xi.tail<3>());
  Matrix6d A;
  A << W, skew(xi.head<3>()), Eigen::Matrix3d::Zero(), W;
  return A;
}

}  // namespace

Matrix6d left_jacobian(const Vector6d& xi) {
  const Matrix6d ad = bracket(xi);
  Matrix6d sum = Matrix6d::Identity(), term = Matrix6d::Identity();
  // Sum of ad^k / (k + 1)!, which converges for every xi: terms are below rounding after a few for the small
  // displacements of a prior, after fewer than kMaxTerms for rotations by pi.
  constexpr int kMaxTerms = 40;
  constexpr double kBelowRounding = 1e-17;
  for (int k = 1; k < kMaxTerms; ++k) {
    term = (term * ad / (k + 1)).eval();
    sum += term;
    if (term.cwiseAbs().maxCoeff() < kBelowRounding) break;
  }
  return sum;
}

PriorTerm::PriorTerm(const BaProblem& problem) : problem_(problem) {
  if (!problem.prior) return;
  for (const int id : problem.prior->pose_ids) {
    const auto found = std::find(problem.pose_ids.begin(), problem.pose_ids.end(), id);
    pose_index_.push_back(static_cast<int>(found - problem.pose_ids.begin()));
  }
}

Eigen::VectorXd PriorTerm::displacement(const std::vector<SE3>& poses) const {
  Eigen::VectorXd xi(6 * pose_index_.size());
  for (std::size_t i = 0; i < pose_index_.size(); ++i)
    xi.segment<6>(6 * i) = (poses[pose_index_[i]] * problem_.prior->linearization[i].inverse()).log();
  return xi;
}

double PriorTerm::cost(const Eigen::VectorXd& xi) const {
  const BaPrior& prior = *problem_.prior;
  return 0.5 * xi.dot(prior.H * xi) + prior.b.dot(xi) + prior.constant;
}

double PriorTerm::add(const std::vector<SE3>& poses, Eigen::MatrixXd* H, Eigen::VectorXd* b) const {
  if (empty()) return 0;
  const BaPrior& prior = *problem_.prior;
  const Eigen::VectorXd xi = displacement(poses);
  const Eigen::VectorXd gradient = prior.H * xi + prior.b;
  const std::size_t n = pose_index_.size();
  std::vector<Matrix6d> J(n);
  for (std::size_t i = 0; i < n; ++i) J[i] = left_jacobian(xi.segment<6>(6 * i)).inverse();
  for (std::size_t i = 0; i < n; ++i) {
    const int row = 6 * pose_index_[i];
    b->segment<6>(row) += J[i].transpose() * gradient.segment<6>(6 * i);
    for (std::size_t j = 0; j < n; ++j)
      H->block<6, 6>(row, 6 * pose_index_[j]) += J[i].transpose() * prior.H.block<6, 6>(6 * i, 6 * j) * J[j];
  }
  return cost(xi);
}

}  // namespace edgevo::ba
