// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/corner_residual.h"

#include "edgevo/bundle_adjustment/epipolar_lines.h"
#include "edgevo/core/robust.h"

namespace edgevo::ba {

CornerLinearization linearize(const Pinhole& pinhole, const SE3& T_to_from, const BaCornerPair& pair) {
  const EpipolarLines lines = epipolar_lines(T_to_from, pair.ray_from, pair.ray_to);
  const Eigen::Vector3d Rx = T_to_from.rotation() * pair.ray_from;
  const double scale = pair.inv_sigma * pinhole.fx / lines.length;
  CornerLinearization lin;
  lin.residual = scale * lines.in_to.dot(pair.ray_to);
  lin.J_to << scale * Rx.cross(pair.ray_to), scale * lines.in_to.cross(pair.ray_to);
  return lin;
}

double CornerTerm::cost(const std::vector<SE3>& poses) const {
  double cost = 0;
  for (const BaCornerPair& p : pairs_)
    cost += huber_cost(linearize(pinhole_, poses[p.to] * poses[p.from].inverse(), p).residual, huber_width_);
  return cost;
}

double CornerTerm::add(const std::vector<SE3>& poses, Eigen::MatrixXd* H, Eigen::VectorXd* b) const {
  double cost = 0;
  // One pair of keyframes after the other.
  for (size_t begin = 0, end = 0; begin < pairs_.size(); begin = end) {
    const int from = 6 * pairs_[begin].from, to = 6 * pairs_[begin].to;
    const SE3 T_to_from = poses[pairs_[begin].to] * poses[pairs_[begin].from].inverse();
    Matrix6d A = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (; end < pairs_.size() && 6 * pairs_[end].from == from && 6 * pairs_[end].to == to; ++end) {
      const CornerLinearization lin = linearize(pinhole_, T_to_from, pairs_[end]);
      const double w = huber_weight(lin.residual, huber_width_);
      A.noalias() += w * lin.J_to * lin.J_to.transpose();
      g.noalias() += w * lin.residual * lin.J_to;
      cost += huber_cost(lin.residual, huber_width_);
    }
    const Matrix6d Ad = T_to_from.adjoint(), A_Ad = A * Ad;
    H->block<6, 6>(to, to) += A;
    H->block<6, 6>(to, from) -= A_Ad;
    H->block<6, 6>(from, to) -= A_Ad.transpose();
    H->block<6, 6>(from, from) += Ad.transpose() * A_Ad;
    b->segment<6>(to) += g;
    b->segment<6>(from) -= Ad.transpose() * g;
  }
  return cost;
}

}  // namespace edgevo::ba
