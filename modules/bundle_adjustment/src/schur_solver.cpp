// SPDX-License-Identifier: BSD-3-Clause
// edgevo's own solver: Levenberg-Marquardt with the scalar inverse depths eliminated.
//
// With Marquardt's scaling the damped system of a point is (1 + lambda) times its information, so that the
// Schur complement is H + lambda D - S / (1 + lambda): S is summed once per linearisation, and a rejected
// step costs only a 6n x 6n factorisation. The linearisation of a trial state also gives its cost and is used
// for the next step if the trial is accepted; for a trial predicted to be the last only cost and depths are
// summed.
#include <algorithm>
#include <cmath>

#include "dense_solve.h"
#include "normal_equations.h"
#include "pose_terms.h"
#include "solvers.h"

namespace edgevo::ba {
namespace {

// Bounds of the damping, shares of the diagonal. Above the upper bound steps are below rounding and cannot
// lower the cost. Below the lower bound it has no effect and would take too long to grow when needed.
constexpr double kMaxLambda = 1e16, kMinLambda = 1e-16;
// Share of the cost: the accuracy of sums of thousands of residuals.
constexpr double kMinDecrease = 1e-14;

// Marquardt's scaling (units as the Hessian's diagonal); bounded below, so that an unobserved pose stays
// unchanged, and above to stay finite.
double damping_scale(double information) { return std::clamp(information, 1e-6, 1e32); }

PackedVector6 pack(const Vector6d& v) { return {{Rows{v[0], v[1]}, Rows{v[2], v[3]}, Rows{v[4], v[5]}}}; }

inline double dot(const PackedVector6& a, const PackedVector6& b) {
  const Rows sum = a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
  return sum[0] + sum[1];
}

struct Step {
  /// Step of the poses, 6 rows per pose, zero for fixed ones.
  Eigen::VectorXd poses;
  /// Step of the inverse depth of each packed point.
  std::vector<double> idepth;
  double predicted_decrease = 0;
};

class Damping {
 public:
  explicit Damping(double initial) : lambda_(initial) {}
  double lambda() const { return lambda_; }
  /// Reduces the damping by Nielsen's formula, a smooth function of the gain of the accepted step.
  void accept(double gain) {
    lambda_ *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3));
    lambda_ = std::max(lambda_, kMinLambda);
    factor_ = 2;
  }
  void reject() {
    lambda_ *= factor_;
    factor_ *= 2;
  }

 private:
  double lambda_, factor_ = 2;
};

class Minimizer {
 public:
  Minimizer(const BaProblem& problem, const BaOptions& options)
      : options_(options),
        state_(initial_state(problem, options.min_idepth)),
        packed_(pack_problem(problem, state_, nullptr)),
        pose_terms_(problem, options.huber_width),
        builder_(packed_, options.huber_width),
        damping_(options.initial_damping) {
    for (int i = 0; i < packed_.pose_count; ++i)
      if (!problem.poses[i].fixed) free_poses_.push_back(i);
    trial_ = state_;
    step_.idepth.resize(packed_.points.size());
  }

  BaResult run();
  const State& state() const { return state_; }
  const PackedProblem& packed() const { return packed_; }
  const NormalEquations& equations() const { return now_; }

 private:
  void linearize(const State& state, NormalEquations* equations) {
    builder_.build(state, equations);
    pose_terms_.add(state.poses, equations);
  }
  void evaluate(const State& state, NormalEquations* equations) {
    builder_.build_cost_and_depths(state, equations);
    pose_terms_.add_cost(state.poses, equations);
  }
  bool is_enough(double decrease) const {
    return decrease <= options_.relative_decrease * std::abs(now_.cost);
  }
  bool solve_step();
  bool solve_poses();
  void solve_idepths();
  void apply_step();

  const BaOptions& options_;
  State state_, trial_;
  PackedProblem packed_;
  PoseTerms pose_terms_;
  NormalEquationsBuilder builder_;
  /// Normal equations at state_ and at trial_.
  NormalEquations now_, next_;
  std::vector<int> free_poses_;
  Damping damping_;
  Step step_;
};

// (H + lambda D - S / (1 + lambda)) delta = -(b - s / (1 + lambda)) over the free poses.
bool Minimizer::solve_poses() {
  const double lambda = damping_.lambda(), k = 1.0 / (1.0 + lambda);
  const int m = static_cast<int>(free_poses_.size());
  step_.poses.setZero(6 * packed_.pose_count);
  if (m == 0) return true;
  Eigen::MatrixXd A(6 * m, 6 * m);
  Eigen::VectorXd rhs(6 * m);
  for (int i = 0; i < m; ++i) {
    const int row = 6 * free_poses_[i];
    rhs.segment<6>(6 * i) = k * now_.s.segment<6>(row) - now_.b.segment<6>(row);
    for (int j = 0; j < m; ++j) {
      const int col = 6 * free_poses_[j];
      A.block<6, 6>(6 * i, 6 * j) = now_.H.block<6, 6>(row, col) - k * now_.S.block<6, 6>(row, col);
    }
    for (int d = 0; d < 6; ++d) A(6 * i + d, 6 * i + d) += lambda * damping_scale(now_.H(row + d, row + d));
  }
  const Eigen::VectorXd delta = solve_positive(A, rhs);
  if (!delta.allFinite()) return false;
  for (int i = 0; i < m; ++i) step_.poses.segment<6>(6 * free_poses_[i]) = delta.segment<6>(6 * i);
  for (int i = 0; i < 6 * packed_.pose_count; ++i) {
    const double x = step_.poses[i];
    step_.predicted_decrease += 0.5 * x * (lambda * damping_scale(now_.H(i, i)) * x - now_.b[i]);
  }
  return true;
}

void Minimizer::solve_idepths() {
  const double lambda = damping_.lambda();
  const int n = packed_.pose_count;
  std::vector<PackedVector6> relative(n);  // step of each target relative to the host
  for (int h = 0; h < n; ++h) {
    const Vector6d host = step_.poses.segment<6>(6 * h);
    for (int t = packed_.targets[h].first; t <= packed_.targets[h].last; ++t)
      relative[t] = pack(step_.poses.segment<6>(6 * t) - now_.adjoint[h * n + t] * host);
    for (int i = packed_.host_begin[h]; i < packed_.host_begin[h + 1]; ++i) {
      const PackedPoint& p = packed_.points[i];
      const double information = now_.idepth_information[i];
      step_.idepth[i] = 0;
      if (p.fixed || !(information > kMinIdepthInformation)) continue;
      double residual = now_.idepth_gradient[i];
      for (int k = p.begin; k < p.end; ++k)
        residual += dot(now_.coupling[k], relative[packed_.observations[k].target]);
      const double x = -residual / (information * (1.0 + lambda));
      step_.idepth[i] = x;
      step_.predicted_decrease += 0.5 * x * (lambda * information * x - now_.idepth_gradient[i]);
    }
  }
}

bool Minimizer::solve_step() {
  step_.predicted_decrease = 0;
  if (!solve_poses()) return false;
  solve_idepths();
  return step_.predicted_decrease >= 0;  // false for a failed factorisation and for NaN
}

void Minimizer::apply_step() {
  for (const int i : free_poses_) trial_.poses[i] = SE3::exp(step_.poses.segment<6>(6 * i)) * state_.poses[i];
  for (std::size_t i = 0; i < packed_.points.size(); ++i) {
    const PackedPoint& p = packed_.points[i];
    if (!p.fixed)
      trial_.idepth[p.index] = std::max(state_.idepth[p.index] + step_.idepth[i], options_.min_idepth);
  }
}

BaResult Minimizer::run() {
  BaResult result;
  linearize(state_, &now_);
  result.initial_cost = result.final_cost = now_.cost;
  if (!std::isfinite(now_.cost) || (packed_.observations.empty() && pose_terms_.empty())) return result;
  result.usable = true;
  while (result.iterations < options_.max_iterations && damping_.lambda() < kMaxLambda) {
    ++result.iterations;
    if (!solve_step()) {
      damping_.reject();
      continue;
    }
    if (step_.predicted_decrease <= kMinDecrease * std::abs(now_.cost)) break;  // at the minimum
    apply_step();
    const bool expected_last =
        result.iterations == options_.max_iterations || is_enough(step_.predicted_decrease);
    if (expected_last)
      evaluate(trial_, &next_);
    else
      linearize(trial_, &next_);
    const double decrease = now_.cost - next_.cost;
    if (!(decrease > 0)) {  // also when not finite
      damping_.reject();
      continue;
    }
    const bool converged = is_enough(decrease);
    damping_.accept(decrease / step_.predicted_decrease);
    std::swap(state_, trial_);
    std::swap(now_, next_);
    if (converged) break;
    if (expected_last && result.iterations < options_.max_iterations) linearize(state_, &now_);
  }
  result.final_cost = now_.cost;
  return result;
}

class SchurSolver : public BundleAdjuster {
 public:
  std::string name() const override { return "schur"; }

  BaResult solve(BaProblem* problem, const BaOptions& options) override {
    check_problem(*problem);
    if (!is_finite(*problem) || !has_unknowns(*problem)) return unusable_result(*problem);
    Minimizer minimizer(*problem, options);
    BaResult result = minimizer.run();
    if (!result.usable) return unusable_result(*problem);
    store(minimizer.state(), problem);
    fill_sigmas(minimizer.packed(), minimizer.equations().idepth_information, problem->points.size(),
                &result);
    fill_residuals(*problem, &result);
    return result;
  }
};

}  // namespace

std::unique_ptr<BundleAdjuster> make_schur_solver() { return std::make_unique<SchurSolver>(); }

}  // namespace edgevo::ba
