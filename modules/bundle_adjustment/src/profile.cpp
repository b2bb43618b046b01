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
constexpr double kDiagonalShare = 1e-9, kLeastDiagonal = 1e-12;

// One observation with its derivative by k.
struct Row {
  EdgeLinearization lin;
  ImageRate J_k;
  double weight;
};

// d r / dk = W (J_pi R dx/dk - dm/dk), Eq. (reprojectionerror) with ray x and match m moving with k, where W
// stays.
ImageRate global_jacobian(const Pinhole& c, const TargetFromHost& T, const BaObservation& o, const BaPoint& p,
                          const ImageRate& ray_rate, const ImageRate& px_rate) {
  const Eigen::Vector3d Y = T.R * p.ray + p.idepth * T.t;
  const Eigen::Matrix<double, 3, kUnknowns> dY = T.R.leftCols<2>() * ray_rate;
  ImageRate moved;
  moved.row(0) = c.fx / Y.z() * (dY.row(0) - Y.x() / Y.z() * dY.row(2)) - px_rate.row(0);
  moved.row(1) = c.fy / Y.z() * (dY.row(1) - Y.y() / Y.z() * dY.row(2)) - px_rate.row(1);
  Eigen::Matrix2d W;  // along the normal, across it
  W.row(0) = o.inv_sigma_normal * o.normal.transpose();
  W.row(1) = o.inv_sigma_tangent * Eigen::RowVector2d(-o.normal.y(), o.normal.x());
  return W * moved;
}

class Profile {
 public:
  Profile(const BaProblem& problem, const GlobalDerivative& derivative, const BaOptions& options)
      : problem_(problem),
        derivative_(derivative),
        options_(options),
        H_k_(PoseRows::Zero(6 * problem.poses.size(), kUnknowns)) {
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
    step.idepth_rate.resize(problem_.points.size());
    for (size_t i = 0; i < problem_.points.size(); ++i)
      step.idepth_rate[i] = idepth_rate(int(i), step.pose_rate);
    sum_score(&step);
    step.usable = step.gradient.allFinite() && step.curvature.allFinite();
    return step;
  }

 private:
  using PoseRows = Eigen::Matrix<double, Eigen::Dynamic, kUnknowns>;
  using IdepthRate = Eigen::Matrix<double, 1, kUnknowns>;

  Row row(int observation) const {
    const BaObservation& o = problem_.observations[observation];
    const BaPoint& p = problem_.points[o.point];
    const TargetFromHost& T = relative_[size_t(p.host) * problem_.poses.size() + size_t(o.target)];
    Row r{linearize(problem_.pinhole, T, p, o), ImageRate::Zero(), 0};
    if (!r.lin.valid) return r;
    r.J_k = global_jacobian(problem_.pinhole, T, o, p, derivative_.ray[o.point], derivative_.px[observation]);
    r.J_k += r.lin.residual * derivative_.log_inv_sigma.transpose();
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
      const Row& r = rows_[k];
      const ImageRate J = r.weight * (r.J_k + r.lin.J_idepth * rate);
      H_k_.middleRows<6>(6 * problem_.observations[k].target) += r.lin.J_target.transpose() * J;
      H_k_.middleRows<6>(6 * p.host) += r.lin.J_host.transpose() * J;
    }
  }

  // dpose/dk = -(H - S)^-1 H_k over the free poses.
  bool solve_poses(PoseRows* rate) const {
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
    PoseRows b(m, kUnknowns);
    for (int i = 0; i < m; ++i) {
      b.row(i) = -H_k_.row(free_rows[i]);
      for (int j = 0; j < m; ++j)
        A(i, j) = equations.H(free_rows[i], free_rows[j]) - equations.S(free_rows[i], free_rows[j]);
      A(i, i) += kDiagonalShare * equations.H(free_rows[i], free_rows[i]) + kLeastDiagonal;
    }
    const PoseRows x = solve_positive(A, b);
    rate->setZero(6 * problem_.poses.size(), kUnknowns);
    for (int i = 0; i < m; ++i) rate->row(free_rows[i]) = x.row(i);
    return x.allFinite();
  }

  // Derivative of a residual along the path of minima, without the share of its depth.
  ImageRate along_poses(const Row& r, int observation, const PoseRows& pose_rate) const {
    const BaObservation& o = problem_.observations[observation];
    return r.J_k + r.lin.J_target * pose_rate.middleRows<6>(6 * o.target) +
           r.lin.J_host * pose_rate.middleRows<6>(6 * problem_.points[o.point].host);
  }

  IdepthRate idepth_rate(int point, const PoseRows& pose_rate) const {
    if (problem_.points[point].fixed) return IdepthRate::Zero();
    double information = 0;
    IdepthRate coupling = IdepthRate::Zero();
    for (int k = first_[point]; k < first_[point + 1]; ++k) {
      const Row& r = rows_[k];
      information += r.weight * r.lin.J_idepth.squaredNorm();
      coupling += r.weight * r.lin.J_idepth.transpose() * along_poses(r, k, pose_rate);
    }
    if (!(information > kMinIdepthInformation)) return IdepthRate::Zero();
    return -coupling / information;
  }

  void sum_score(ProfileStep* step) const {
    std::vector<Unknowns> score(problem_.poses.size(), Unknowns::Zero());
    for (size_t k = 0; k < problem_.observations.size(); ++k) {
      const int point = problem_.observations[k].point;
      const Row& r = rows_[k];
      if (!r.lin.valid) continue;
      const ImageRate total =
          along_poses(r, int(k), step->pose_rate) + r.lin.J_idepth * step->idepth_rate[point];
      const Unknowns part = r.weight * total.transpose() * r.lin.residual;
      step->gradient += part;
      step->curvature += r.weight * total.transpose() * total;
      score[problem_.points[point].host] += part;
    }
    for (const Unknowns& s : score) step->score_square += s * s.transpose();
  }

  const BaProblem& problem_;
  const GlobalDerivative& derivative_;
  const BaOptions& options_;
  std::vector<TargetFromHost> relative_;  // at host * poses + target
  std::vector<int> first_;                // observations of point i: [first_[i], first_[i + 1])
  std::vector<Row> rows_;                 // per observation
  PoseRows H_k_;                          // sum w J_pose^T J_k, depths eliminated
};

}  // namespace

ProfileStep profile_step(const BaProblem& problem, const GlobalDerivative& derivative,
                         const BaOptions& options) {
  return Profile(problem, derivative, options).run();
}

}  // namespace edgevo::ba
