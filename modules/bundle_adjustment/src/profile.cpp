// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/bundle_adjustment/profile.h"

#include <cmath>
#include <vector>

#include "dense_solve.h"
#include "edgevo/bundle_adjustment/problem_index.h"
#include "edgevo/core/robust.h"
#include "normal_equations.h"
#include "prior.h"
#include "residuals/edge_residual.h"

namespace edgevo::ba {
namespace {

// Damping of the pose system: a share of its diagonal and, in its own units, a minimum. Unconstrained poses
// then have a rate of zero instead of none. Far below the diagonal of any observed pose.
constexpr double kDiagonalShare = 1e-9, kMinDiagonal = 1e-12;

// Derivative of an image point by the first N unknowns.
template <int N>
using Rate = Eigen::Matrix<double, 2, N>;

// One observation with its derivative by k.
template <int N>
struct Row {
  EdgeLinearization lin;
  Rate<N> J_k;
  double weight;
};

// d r / dk = W (J_pi R dx/dk - dm/dk), Eq. (reprojectionerror) with ray x and match m moving with k, where W
// stays.
template <int N>
Rate<N> global_jacobian(const Pinhole& c, const TargetFromHost& T, const BaObservation& o, const BaPoint& p,
                        const Rate<N>& ray_rate, const Rate<N>& px_rate) {
  const Eigen::Vector3d Y = T.R * p.ray + p.idepth * T.t;
  const Eigen::Matrix<double, 3, N> dY = T.R.leftCols<2>() * ray_rate;
  Rate<N> moved;
  moved.row(0) = c.fx / Y.z() * (dY.row(0) - Y.x() / Y.z() * dY.row(2)) - px_rate.row(0);
  moved.row(1) = c.fy / Y.z() * (dY.row(1) - Y.y() / Y.z() * dY.row(2)) - px_rate.row(1);
  Eigen::Matrix2d W;  // along the normal, across it
  W.row(0) = o.inv_sigma_normal * o.normal.transpose();
  W.row(1) = o.inv_sigma_tangent * Eigen::RowVector2d(-o.normal.y(), o.normal.x());
  return W * moved;
}

// By the first N unknowns; derivatives by the others are zero.
template <int N>
class Profile {
 public:
  Profile(const BaProblem& problem, const GlobalDerivative& derivative, const BaOptions& options)
      : problem_(problem),
        derivative_(derivative),
        options_(options),
        H_k_(PoseRows::Zero(6 * problem.poses.size(), N)) {
    relative_.reserve(problem.poses.size() * problem.poses.size());
    for (const BaPose& host : problem.poses)
      for (const BaPose& target : problem.poses) relative_.emplace_back(target.T_cam_world, host.T_cam_world);
  }

  ProfileStep run() {
    ProfileStep step;
    first_ = index_problem(problem_).first_observation;
    rows_.reserve(problem_.observations.size());
    for (size_t k = 0; k < problem_.observations.size(); ++k) rows_.push_back(row(int(k)));
    for (size_t i = 0; i < problem_.points.size(); ++i) reduce_point(int(i));
    if (!solve_poses(&step.pose_rate)) return step;
    const PoseRows pose_rate = step.pose_rate.template leftCols<N>();
    step.idepth_rate.assign(problem_.points.size(), Eigen::Matrix<double, 1, kUnknowns>::Zero());
    std::vector<IdepthRate> idepth_rates(problem_.points.size());
    for (size_t i = 0; i < problem_.points.size(); ++i) {
      idepth_rates[i] = idepth_rate(int(i), pose_rate);
      step.idepth_rate[i].template leftCols<N>() = idepth_rates[i];
    }
    sum_score(pose_rate, idepth_rates, &step);
    step.usable = step.gradient.allFinite() && step.curvature.allFinite();
    return step;
  }

 private:
  using PoseRows = Eigen::Matrix<double, Eigen::Dynamic, N>;
  using AllPoseRows = Eigen::Matrix<double, Eigen::Dynamic, kUnknowns>;
  using IdepthRate = Eigen::Matrix<double, 1, N>;

  Row<N> row(int observation) const {
    const BaObservation& o = problem_.observations[observation];
    const BaPoint& p = problem_.points[o.point];
    const TargetFromHost& T = relative_[size_t(p.host) * problem_.poses.size() + size_t(o.target)];
    Row<N> r{linearize(problem_.pinhole, T, p, o), Rate<N>::Zero(), 0};
    if (!r.lin.valid) return r;
    r.J_k = global_jacobian<N>(problem_.pinhole, T, o, p, derivative_.ray[o.point].template leftCols<N>(),
                               derivative_.px[observation].template leftCols<N>());
    r.J_k += r.lin.residual * derivative_.log_inv_sigma.template head<N>().transpose();
    r.weight = huber_weight(r.lin.residual.norm(), options_.huber_width);
    return r;
  }

  // With the point's depth eliminated: H_k = sum w J_pose^T (J_k - J_rho (sum w J_rho J_k) / (sum w
  // J_rho^2)).
  void reduce_point(int point) {
    double information = 0;
    IdepthRate coupling = IdepthRate::Zero();
    for (int k = first_[point]; k < first_[point + 1]; ++k) {
      information += rows_[k].weight * rows_[k].lin.J_idepth.squaredNorm();
      coupling += rows_[k].weight * rows_[k].lin.J_idepth.transpose() * rows_[k].J_k;
    }
    const BaPoint& p = problem_.points[point];
    IdepthRate rate = IdepthRate::Zero();
    if (!p.fixed && information > kMinIdepthInformation) rate = -coupling / information;
    for (int k = first_[point]; k < first_[point + 1]; ++k) {
      const Row<N>& r = rows_[k];
      const Rate<N> J = r.weight * (r.J_k + r.lin.J_idepth * rate);
      H_k_.template middleRows<6>(6 * problem_.observations[k].target) += r.lin.J_target.transpose() * J;
      H_k_.template middleRows<6>(6 * p.host) += r.lin.J_host.transpose() * J;
    }
  }

  // dpose/dk = -(H - S)^-1 H_k over the free poses. Always for all unknowns, so that the order of the sums in
  // the factorisation, and with it the result, does not depend on N.
  bool solve_poses(AllPoseRows* rate) const {
    const State state = initial_state(problem_, options_.min_idepth);
    const PackedProblem packed = pack_problem(problem_, state, nullptr);
    NormalEquations equations;
    NormalEquationsBuilder(packed, options_.huber_width).build(state, &equations);
    PriorTerm(problem_).add(state.poses, &equations.H, &equations.b);
    std::vector<int> free_rows;
    for (size_t i = 0; i < problem_.poses.size(); ++i)
      if (!problem_.poses[i].fixed)
        for (int d = 0; d < 6; ++d) free_rows.push_back(int(6 * i) + d);
    const int m = int(free_rows.size());
    Eigen::MatrixXd A(m, m);
    AllPoseRows b = AllPoseRows::Zero(m, kUnknowns);
    for (int i = 0; i < m; ++i) {
      b.row(i).template head<N>() = -H_k_.row(free_rows[i]);
      for (int j = 0; j < m; ++j)
        A(i, j) = equations.H(free_rows[i], free_rows[j]) - equations.S(free_rows[i], free_rows[j]);
      A(i, i) += kDiagonalShare * equations.H(free_rows[i], free_rows[i]) + kMinDiagonal;
    }
    const AllPoseRows x = solve_positive(A, b);
    rate->setZero(6 * problem_.poses.size(), kUnknowns);
    for (int i = 0; i < m; ++i) rate->row(free_rows[i]) = x.row(i);
    return x.allFinite();
  }

  // Derivative of a residual along the path of minima, without the share of its depth.
  Rate<N> along_poses(const Row<N>& r, int observation, const PoseRows& pose_rate) const {
    const BaObservation& o = problem_.observations[observation];
    return r.J_k + r.lin.J_target * pose_rate.template middleRows<6>(6 * o.target) +
           r.lin.J_host * pose_rate.template middleRows<6>(6 * problem_.points[o.point].host);
  }

  IdepthRate idepth_rate(int point, const PoseRows& pose_rate) const {
    if (problem_.points[point].fixed) return IdepthRate::Zero();
    double information = 0;
    IdepthRate coupling = IdepthRate::Zero();
    for (int k = first_[point]; k < first_[point + 1]; ++k) {
      const Row<N>& r = rows_[k];
      information += r.weight * r.lin.J_idepth.squaredNorm();
      coupling += r.weight * r.lin.J_idepth.transpose() * along_poses(r, k, pose_rate);
    }
    if (!(information > kMinIdepthInformation)) return IdepthRate::Zero();
    return -coupling / information;
  }

  void sum_score(const PoseRows& pose_rate, const std::vector<IdepthRate>& idepth_rates,
                 ProfileStep* step) const {
    using Sum = Eigen::Matrix<double, N, 1>;
    std::vector<Sum> score(problem_.poses.size(), Sum::Zero());
    for (size_t k = 0; k < problem_.observations.size(); ++k) {
      const int point = problem_.observations[k].point;
      const Row<N>& r = rows_[k];
      if (!r.lin.valid) continue;
      const Rate<N> total = along_poses(r, int(k), pose_rate) + r.lin.J_idepth * idepth_rates[point];
      const Sum part = r.weight * total.transpose() * r.lin.residual;
      step->gradient.template head<N>() += part;
      step->curvature.template topLeftCorner<N, N>() += r.weight * total.transpose() * total;
      score[problem_.points[point].host] += part;
    }
    for (const Sum& s : score) step->score_square.template topLeftCorner<N, N>() += s * s.transpose();
  }

  const BaProblem& problem_;
  const GlobalDerivative& derivative_;
  const BaOptions& options_;
  std::vector<TargetFromHost> relative_;  // at host * poses + target
  std::vector<int> first_;                // observations of point i: [first_[i], first_[i + 1])
  std::vector<Row<N>> rows_;              // per observation
  PoseRows H_k_;                          // sum w J_pose^T J_k, depths eliminated
};

}  // namespace

ProfileStep profile_step(const BaProblem& problem, const GlobalDerivative& derivative,
                         const BaOptions& options, bool only_first) {
  return only_first ? Profile<kFirstUnknowns>(problem, derivative, options).run()
                    : Profile<kUnknowns>(problem, derivative, options).run();
}

}  // namespace edgevo::ba
