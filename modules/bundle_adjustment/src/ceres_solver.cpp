// SPDX-License-Identifier: BSD-3-Clause
// The reference solver: the same cost through Ceres, point depths in the first elimination group.
#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "normal_equations.h"
#include "prior.h"
#include "residuals/corner_residual.h"
#include "residuals/edge_residual.h"
#include "residuals/turn_residual.h"
#include "solvers.h"

namespace edgevo::ba {
namespace {

/// Quaternion x y z w, then the translation.
using PoseBlock = std::array<double, 7>;
using PoseJacobian = Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>;

SE3 to_se3(const double* x) {
  return {Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(x)), Eigen::Vector3d(x[4], x[5], x[6])};
}

void from_se3(const SE3& T, double* x) {
  Eigen::Map<Eigen::Vector4d>{x} = T.rotation().coeffs();
  Eigen::Map<Eigen::Vector3d>{x + 4} = T.translation();
}

// T_cam_world <- exp(xi) T_cam_world. Ceres only ever multiplies a cost's Jacobian by PlusJacobian, so with
// [I; 0] here the costs return their six derivatives by xi followed by a zero, and the quaternion never has
// to be differentiated.
class LeftPerturbation : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    from_se3(SE3::exp(Eigen::Map<const Vector6d>(delta)) * to_se3(x), x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<Vector6d>{y_minus_x} = (to_se3(y) * to_se3(x).inverse()).log();
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
};

void write_pose_jacobian(const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, 6>>& J, double* out) {
  Eigen::Map<PoseJacobian> map(out, J.rows(), 7);
  map.leftCols<6>() = J;
  map.col(6).setZero();
}

class ReprojectionCost : public ceres::SizedCostFunction<2, 7, 7, 1> {  // target, host, inverse depth
 public:
  ReprojectionCost(const Pinhole& pinhole, const BaPoint& point, const BaObservation& observation)
      : pinhole_(pinhole), point_(point), observation_(observation) {}

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    BaPoint point = point_;
    point.idepth = x[2][0];
    EdgeLinearization lin = linearize(pinhole_, to_se3(x[0]), to_se3(x[1]), point, observation_);
    if (!lin.valid) lin.residual = {kHiddenResidualPx * observation_.inv_sigma_normal, 0};
    Eigen::Map<Eigen::Vector2d>{residuals} = lin.residual;
    if (!jacobians) return true;
    if (jacobians[0]) write_pose_jacobian(lin.J_target, jacobians[0]);
    if (jacobians[1]) write_pose_jacobian(lin.J_host, jacobians[1]);
    if (jacobians[2]) Eigen::Map<Eigen::Vector2d>{jacobians[2]} = lin.J_idepth;
    return true;
  }

 private:
  const Pinhole& pinhole_;
  const BaPoint& point_;
  const BaObservation& observation_;
};

class KnownDepthCost : public ceres::SizedCostFunction<1, 1> {
 public:
  explicit KnownDepthCost(const PackedPoint& point)
      : known_(point.known_idepth), inv_sigma_(std::sqrt(point.known_information)) {}

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    residuals[0] = inv_sigma_ * (x[0][0] - known_);
    if (jacobians && jacobians[0]) jacobians[0][0] = inv_sigma_;
    return true;
  }

 private:
  double known_, inv_sigma_;
};

class CornerCost : public ceres::SizedCostFunction<1, 7, 7> {
 public:
  CornerCost(const Pinhole& pinhole, const BaCornerPair& pair) : pinhole_(pinhole), pair_(pair) {}

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const SE3 T_to_from = to_se3(x[0]) * to_se3(x[1]).inverse();
    const CornerLinearization lin = linearize(pinhole_, T_to_from, pair_);
    residuals[0] = lin.residual;
    if (!jacobians) return true;
    const Eigen::Matrix<double, 1, 6> J_to = lin.J_to.transpose();
    if (jacobians[0]) write_pose_jacobian(J_to, jacobians[0]);
    if (jacobians[1]) write_pose_jacobian(-J_to * T_to_from.adjoint(), jacobians[1]);
    return true;
  }

 private:
  const Pinhole& pinhole_;
  const BaCornerPair& pair_;
};

class TurnCost : public ceres::SizedCostFunction<3, 7, 7> {
 public:
  explicit TurnCost(const BaTurn& turn) : turn_(turn), root_(turn.information.llt().matrixU()) {}

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const SE3 T_to_from = to_se3(x[0]) * to_se3(x[1]).inverse();
    Eigen::Map<Eigen::Vector3d>(residuals, 3) = root_ * turn_residual(T_to_from, turn_);
    if (!jacobians) return true;
    Eigen::Matrix<double, 3, 6> J_to = Eigen::Matrix<double, 3, 6>::Zero();
    J_to.rightCols<3>() = root_;
    if (jacobians[0]) write_pose_jacobian(J_to, jacobians[0]);
    if (jacobians[1]) write_pose_jacobian(-J_to * T_to_from.adjoint(), jacobians[1]);
    return true;
  }

 private:
  const BaTurn& turn_;
  Eigen::Matrix3d root_;
};

// E(xi) = 1/2 |A xi + c|^2 + offset with A = sqrt(D) V^T, c = D^-1/2 V^T b from H = V D V^T.
class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(const BaPrior& prior) : prior_(prior) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(prior.H);
    const Eigen::VectorXd& D = eigen.eigenvalues();
    const double cut = 1e-14 * std::max(D.cwiseAbs().maxCoeff(), 1e-300);
    A_.setZero(D.size(), D.size());
    c_.setZero(D.size());
    for (Eigen::Index i = 0; i < D.size(); ++i) {
      if (D[i] <= cut) continue;
      A_.row(i) = std::sqrt(D[i]) * eigen.eigenvectors().col(i).transpose();
      c_[i] = eigen.eigenvectors().col(i).dot(prior.b) / std::sqrt(D[i]);
    }
    set_num_residuals(static_cast<int>(D.size()));
    mutable_parameter_block_sizes()->assign(prior.pose_ids.size(), 7);
  }
  double offset() const { return prior_.constant - 0.5 * c_.squaredNorm(); }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const std::size_t n = prior_.linearization.size();
    Eigen::VectorXd xi(6 * n);
    for (std::size_t i = 0; i < n; ++i)
      xi.segment<6>(6 * i) = (to_se3(x[i]) * prior_.linearization[i].inverse()).log();
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = A_ * xi + c_;
    for (std::size_t i = 0; jacobians && i < n; ++i)
      if (jacobians[i])
        write_pose_jacobian(A_.middleCols<6>(6 * i) * left_jacobian(xi.segment<6>(6 * i)).inverse(),
                            jacobians[i]);
    return true;
  }

 private:
  const BaPrior& prior_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd c_;
};

// A solve: the Ceres problem with the blocks and functions that it points to.
class CeresSolve {
 public:
  CeresSolve(const BaProblem& problem, const BaOptions& options)
      : problem_(problem),
        options_(options),
        state_(initial_state(problem, options.min_idepth)),
        packed_(pack_problem(problem, state_, nullptr)),
        huber_(options.huber_width),
        prior_(problem) {
    for (const SE3& T : state_.poses) from_se3(T, pose_blocks_.emplace_back().data());
    ceres::Problem::Options ownership;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres_ = std::make_unique<ceres::Problem>(ownership);
    add_poses();
    add_points();
    add_corners();
    add_turns();
    add_prior();
  }

  bool empty() const {
    return packed_.observations.empty() && problem_.corners.empty() && problem_.turns.empty() &&
           prior_.empty();
  }
  BaResult run();
  const State& state() const { return state_; }
  const PackedProblem& packed() const { return packed_; }
  NormalEquations equations() const {
    NormalEquations equations;
    NormalEquationsBuilder(packed_, options_.huber_width).build(state_, &equations);
    return equations;
  }

 private:
  void add_poses();
  void add_points();
  void add_corners();
  void add_turns();
  void add_prior();
  ceres::Solver::Options solver_options() const;

  const BaProblem& problem_;
  const BaOptions& options_;
  State state_;
  PackedProblem packed_;
  std::vector<PoseBlock> pose_blocks_;
  LeftPerturbation manifold_;
  ceres::HuberLoss huber_;
  PriorTerm prior_;
  double cost_offset_ = 0;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_ =
      std::make_shared<ceres::ParameterBlockOrdering>();
  std::unique_ptr<ceres::Problem> ceres_;
};

void CeresSolve::add_poses() {
  for (std::size_t i = 0; i < pose_blocks_.size(); ++i) {
    double* block = pose_blocks_[i].data();
    ceres_->AddParameterBlock(block, 7, &manifold_);
    if (problem_.poses[i].fixed) ceres_->SetParameterBlockConstant(block);
    ordering_->AddElementToGroup(block, 1);
  }
}

void CeresSolve::add_points() {
  for (const PackedPoint& p : packed_.points) {
    const BaPoint& point = problem_.points[p.index];
    double* idepth = &state_.idepth[p.index];
    ceres_->AddParameterBlock(idepth, 1);
    ordering_->AddElementToGroup(idepth, 0);
    if (p.fixed) {
      ceres_->SetParameterBlockConstant(idepth);
    } else {
      ceres_->SetParameterLowerBound(idepth, 0, options_.min_idepth);
    }
    if (p.known_information > 0) ceres_->AddResidualBlock(new KnownDepthCost(p), &huber_, idepth);
    for (int k = p.begin; k < p.end; ++k) {
      const BaObservation& o = problem_.observations[packed_.observations[k].index];
      ceres_->AddResidualBlock(new ReprojectionCost(problem_.pinhole, point, o), &huber_,
                               pose_blocks_[o.target].data(), pose_blocks_[point.host].data(), idepth);
    }
  }
}

void CeresSolve::add_corners() {
  for (const BaCornerPair& c : problem_.corners)
    ceres_->AddResidualBlock(new CornerCost(problem_.pinhole, c), &huber_, pose_blocks_[c.to].data(),
                             pose_blocks_[c.from].data());
}

void CeresSolve::add_turns() {
  for (const BaTurn& t : problem_.turns)
    ceres_->AddResidualBlock(new TurnCost(t), &huber_, pose_blocks_[t.to].data(),
                             pose_blocks_[t.from].data());
}

void CeresSolve::add_prior() {
  if (prior_.empty()) return;
  auto* cost = new PriorCost(*problem_.prior);
  cost_offset_ = cost->offset();
  std::vector<double*> blocks;
  for (const int i : prior_.pose_index()) blocks.push_back(pose_blocks_[i].data());
  ceres_->AddResidualBlock(cost, nullptr, blocks);
}

ceres::Solver::Options CeresSolve::solver_options() const {
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_SCHUR;
  o.linear_solver_ordering = ordering_;
  o.num_threads = 1;
  o.max_num_iterations = options_.max_iterations;
  o.function_tolerance = options_.relative_decrease;
  o.initial_trust_region_radius = 1.0 / options_.initial_damping;
  o.gradient_tolerance = 1e-16;
  o.parameter_tolerance = 1e-14;
  o.logging_type = ceres::SILENT;
  return o;
}

BaResult CeresSolve::run() {
  BaResult result;
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(), ceres_.get(), &summary);
  result.usable = summary.IsSolutionUsable();
  result.initial_cost = summary.initial_cost + cost_offset_;
  result.final_cost = summary.final_cost + cost_offset_;
  // Ceres counts the evaluation at the start.
  result.iterations = static_cast<int>(summary.iterations.size()) - 1;
  for (std::size_t i = 0; i < pose_blocks_.size(); ++i) state_.poses[i] = to_se3(pose_blocks_[i].data());
  return result;
}

class CeresSolver : public BundleAdjuster {
 public:
  std::string name() const override { return "ceres"; }

  BaResult solve(BaProblem* problem, const BaOptions& options) override {
    check_problem(*problem);
    if (!is_finite(*problem) || !has_unknowns(*problem)) return unusable_result(*problem);
    CeresSolve solve(*problem, options);
    if (solve.empty()) return unusable_result(*problem);
    BaResult result = solve.run();
    if (!result.usable) return unusable_result(*problem);
    fill_sigmas(solve.packed(), solve.equations().idepth_information, problem->points.size(), &result);
    store(solve.state(), problem);
    fill_residuals(*problem, &result);
    return result;
  }
};

}  // namespace

std::unique_ptr<BundleAdjuster> make_ceres_solver() { return std::make_unique<CeresSolver>(); }

}  // namespace edgevo::ba
