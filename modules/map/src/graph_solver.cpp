// SPDX-License-Identifier: BSD-3-Clause
// Minimises the graph over its nodes, with Ceres, and over the modes of its constraints.
#include "graph_solver.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace edgevo {
namespace {

// Relative decrease of the cost that ends a minimisation. While only modes are sought, where no more than the
// order of the residuals matters: 10 %. To compare modes, which differ by 1 or more in costs up to 1e5: 1e-6.
constexpr double kRoughDecrease = 0.1, kLooseDecrease = 1e-6;
// Relative length of a step that is rounding.
constexpr double kTightStep = 1e-15;
// Decrease of the cost that counts as lower, relative to 1 + cost: above what kLooseDecrease leaves.
constexpr double kLower = 10 * kLooseDecrease;
// Steps of one minimisation: a bound, graphs take five to twenty.
constexpr int kMaxSteps = 100;
// Rounds of choosing modes: a bound, as they may cycle where minimisations are not exact.
constexpr int kMaxRounds = 20;
// Factor between the costs that are tolerated in turn before a constraint fails: half the residual each time,
// until what is tolerated is the noise of one residual.
constexpr double kTolerance = 4, kMinTolerance = 1;
// Evaluations of a constraint that single flips may cost: at 10 us each, with their share of the
// factorisations, 2 s. A flip evaluates each constraint five times or more: large graphs have none.
constexpr double kFlipEffort = 200000;
constexpr int kFlipEvaluations = 5;
// Gauss-Newton but for the regularisation: graphs begin close to their minimum, and more damping would creep
// along long chains. Less would let rounding move what nothing measures.
constexpr double kTrustRadius = 1 / kGraphRegularisation;

// T <- T exp([v, w]), v in units of the world. PlusJacobian is [I; 0]: costs return their six derivatives and
// a zero.
class RightPerturbation : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* sum) const override {
    write(read(x) * SE3::exp(Eigen::Map<const Vector6d>(delta)), sum);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* difference) const override {
    Eigen::Map<Vector6d>{difference} = (read(x).inverse() * read(y)).log();
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }

  static SE3 read(const double* x) {
    return {Eigen::Quaterniond(x[3], x[0], x[1], x[2]), Eigen::Vector3d(x[4], x[5], x[6])};
  }

 private:
  static void write(const SE3& T, double* x) {
    Eigen::Map<Eigen::Vector4d>{x} = T.rotation().coeffs();
    Eigen::Map<Eigen::Vector3d>{x + 4} = T.translation();
  }
};

// Whitened residual of a term in its present mode. Blocks: pose of from, pose of to, scale of the root of
// from, and that of to if it is another.
class TermCost : public ceres::CostFunction {
 public:
  TermCost(const GraphTerm& term, const GraphState& state)
      : term_(term),
        offset_from_(state.offset[term.from]),
        offset_to_(state.offset[term.to]),
        one_scale_(state.root[term.from] == state.root[term.to]) {
    set_num_residuals(static_cast<int>(term.modes[0].whitening.rows()));
    *mutable_parameter_block_sizes() = one_scale_ ? std::vector<int>{7, 7, 1} : std::vector<int>{7, 7, 1, 1};
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Sim3 T_from{std::exp(x[2][0] + offset_from_), RightPerturbation::read(x[0])};
    const Sim3 T_to{std::exp(x[one_scale_ ? 2 : 3][0] + offset_to_), RightPerturbation::read(x[1])};
    const auto& W = term_.modes[term_.mode].whitening;
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    if (!jacobians) {
      r = W * graph_error(term_.constraint, T_from, T_to);
      return r.allFinite();
    }
    const GraphResidual lin = graph_residual(term_.constraint, T_from, T_to);
    r = W * lin.xi;
    const Jacobian J_from = W * lin.J_from, J_to = W * lin.J_to;
    write_pose(J_from, T_from.scale, jacobians[0]);
    write_pose(J_to, T_to.scale, jacobians[1]);
    write_scale(one_scale_ ? J_from.col(6) + J_to.col(6) : Column(J_from.col(6)), jacobians[2]);
    if (!one_scale_) write_scale(J_to.col(6), jacobians[3]);
    return r.allFinite();
  }

 private:
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 7, 0, 7, 7>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 7, 1>;

  // A step v of the manifold is v / s in the unit of the node.
  static void write_pose(const Jacobian& J, double scale, double* out) {
    if (!out) return;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>> map(out, J.rows(), 7);
    map << J.leftCols<3>() / scale, J.middleCols<3>(3), Column::Zero(J.rows());
  }
  static void write_scale(const Column& J, double* out) {
    if (out) Eigen::Map<Eigen::VectorXd>(out, J.size()) = J;
  }

  const GraphTerm& term_;
  double offset_from_, offset_to_;
  bool one_scale_;
};

class Minimiser {
 public:
  explicit Minimiser(GraphState* state) : state_(*state), guess_(state->values), problem_(ownership()) {
    for (size_t i = 0; i < state_.ids.size(); ++i) {
      double* pose = state_.values.poses[i].data();
      problem_.AddParameterBlock(pose, 7, &manifold_);
      if (state_.pose_fixed[i]) problem_.SetParameterBlockConstant(pose);
      if (state_.root[i] != static_cast<int>(i)) continue;
      problem_.AddParameterBlock(&state_.values.log_scales[i], 1);
      if (state_.scale_fixed[i]) problem_.SetParameterBlockConstant(&state_.values.log_scales[i]);
    }
    for (const GraphTerm& term : state_.terms) {
      add(term);
      mixture_ |= term.modes.size() > 1;
    }
  }

  void run(GraphSolution* solution);

 private:
  // The values and modes of a minimum.
  struct Minimum {
    GraphState::Values values;
    std::vector<int> modes;
    double cost = 0;
    bool converged = false;
  };

  static bool is_lower(const Minimum& a, const Minimum& b) {
    return a.cost < b.cost - kLower * (1 + std::abs(b.cost));
  }
  static ceres::Problem::Options ownership() {
    ceres::Problem::Options o;
    o.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return o;
  }

  void add(const GraphTerm& term);
  // Relative rounding error of the cost, a sum over all terms.
  double rounding_of_cost() const {
    return std::numeric_limits<double>::epsilon() *
           std::sqrt(static_cast<double>(std::max<size_t>(1, state_.terms.size())));
  }
  bool minimise(double relative_decrease, int max_steps = kMaxSteps);
  double mode_cost(const GraphTerm& term, const Vector7d& xi, int mode) const;
  Vector7d error(const GraphTerm& term) const {
    return graph_error(term.constraint, state_.node(term.from), state_.node(term.to));
  }
  double failure_gain(const GraphTerm& term) const;
  bool select_modes(double tolerance);
  void begin_at_guess();
  Minimum present() const;
  Minimum descend(double relative_decrease);
  Minimum descend_by_tolerance();
  std::optional<Minimum> descend_from_guess(const Minimum& best);
  void improve_by_flips(Minimum* best);
  std::vector<size_t> failed_terms() const;
  void restore(const Minimum& minimum);

  GraphState& state_;
  const GraphState::Values guess_;
  RightPerturbation manifold_;
  ceres::Problem problem_;
  bool mixture_ = false;
  int iterations_ = 0;
  double evaluations_ = 0;
};

void Minimiser::add(const GraphTerm& term) {
  std::vector<double*> blocks = {state_.values.poses[term.from].data(), state_.values.poses[term.to].data(),
                                 &state_.values.log_scales[state_.root[term.from]]};
  if (state_.root[term.to] != state_.root[term.from])
    blocks.push_back(&state_.values.log_scales[state_.root[term.to]]);
  problem_.AddResidualBlock(new TermCost(term, state_), nullptr, blocks);
}

bool Minimiser::minimise(double relative_decrease, int max_steps) {
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  o.num_threads = 1;
  o.max_num_iterations = max_steps;
  o.initial_trust_region_radius = kTrustRadius;
  o.max_trust_region_radius = kTrustRadius;
  o.function_tolerance = relative_decrease;
  o.gradient_tolerance = 0;
  o.parameter_tolerance = kTightStep;
  o.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(o, &problem_, &summary);
  evaluations_ += static_cast<double>(summary.iterations.size() * state_.terms.size());
  iterations_ += std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  return summary.termination_type == ceres::CONVERGENCE;
}

double Minimiser::mode_cost(const GraphTerm& term, const Vector7d& xi, int mode) const {
  const GraphMode& m = term.modes[mode];
  return (m.whitening * xi).squaredNorm() + m.normalisation;
}

// Cost of the first mode of a term above that of its failure, where the nodes are.
double Minimiser::failure_gain(const GraphTerm& term) const {
  const Vector7d xi = error(term);
  return mode_cost(term, xi, 0) - mode_cost(term, xi, 1);
}

// Every constraint fails that gains more than `tolerance` by it where it is now; whether any mode changed.
bool Minimiser::select_modes(double tolerance) {
  bool changed = false;
  for (GraphTerm& term : state_.terms) {
    if (term.modes.size() < 2) continue;
    const int mode = failure_gain(term) > tolerance ? 1 : 0;
    changed |= mode != term.mode;
    term.mode = mode;
  }
  return changed;
}

Minimiser::Minimum Minimiser::present() const {
  Minimum minimum;
  for (const GraphTerm& term : state_.terms) {
    minimum.modes.push_back(term.mode);
    minimum.cost += mode_cost(term, error(term), term.mode) - term.modes[0].normalisation;
  }
  minimum.values = state_.values;
  return minimum;
}

Minimiser::Minimum Minimiser::descend(double relative_decrease) {
  bool converged = false;
  for (int round = 0; round < kMaxRounds; ++round) {
    converged = minimise(relative_decrease);
    if (!mixture_ || !select_modes(0)) break;
  }
  Minimum minimum = present();
  minimum.converged = converged;
  return minimum;
}

void Minimiser::begin_at_guess() {
  // Ceres keeps pointers to the values: they are copied into place.
  std::copy(guess_.poses.begin(), guess_.poses.end(), state_.values.poses.begin());
  std::copy(guess_.log_scales.begin(), guess_.log_scales.end(), state_.values.log_scales.begin());
  for (GraphTerm& term : state_.terms) term.mode = 0;
}

// However far off the guess is: all constraints hold at first, and the worst fail first, so that those which
// they distort can recover.
Minimiser::Minimum Minimiser::descend_by_tolerance() {
  begin_at_guess();
  minimise(kRoughDecrease);
  double tolerance = 0;
  for (const GraphTerm& term : state_.terms)
    if (term.modes.size() > 1) tolerance = std::max(tolerance, failure_gain(term) / kTolerance);
  for (; tolerance > kMinTolerance; tolerance /= kTolerance)
    if (select_modes(tolerance)) minimise(kRoughDecrease);
  select_modes(0);
  return descend(kLooseDecrease);
}

// However many constraints agree on what is wrong: those fail that contradict the guess. Nothing if one step
// from there does not lead below `best`: a guess that is worth it is close.
std::optional<Minimiser::Minimum> Minimiser::descend_from_guess(const Minimum& best) {
  begin_at_guess();
  select_modes(0);
  minimise(kRoughDecrease, 1);
  select_modes(0);
  if (!is_lower(present(), best)) return std::nullopt;
  return descend(kLooseDecrease);
}

void Minimiser::restore(const Minimum& minimum) {
  std::copy(minimum.values.poses.begin(), minimum.values.poses.end(), state_.values.poses.begin());
  std::copy(minimum.values.log_scales.begin(), minimum.values.log_scales.end(),
            state_.values.log_scales.begin());
  for (size_t i = 0; i < state_.terms.size(); ++i) state_.terms[i].mode = minimum.modes[i];
}

// Terms in their failure mode, those that gain least by it first.
std::vector<size_t> Minimiser::failed_terms() const {
  std::vector<std::pair<double, size_t>> found;
  for (size_t i = 0; i < state_.terms.size(); ++i)
    if (state_.terms[i].mode == 1) found.emplace_back(failure_gain(state_.terms[i]), i);
  std::sort(found.begin(), found.end());
  std::vector<size_t> terms;
  for (const auto& [gain, i] : found) terms.push_back(i);
  return terms;
}

// Lets each failed constraint hold in turn, and the others choose anew.
void Minimiser::improve_by_flips(Minimum* best) {
  const double end = evaluations_ + kFlipEffort;
  const double least = kFlipEvaluations * static_cast<double>(state_.terms.size());
  for (bool improved = true; improved;) {
    improved = false;
    restore(*best);
    for (const size_t i : failed_terms()) {
      if (evaluations_ + least > end) return;
      restore(*best);
      state_.terms[i].mode = 0;
      const Minimum flipped = descend(kLooseDecrease);
      if (!is_lower(flipped, *best)) continue;
      *best = flipped;
      improved = true;
      break;
    }
  }
}

void Minimiser::run(GraphSolution* solution) {
  if (mixture_) {
    Minimum best = descend_by_tolerance();
    const std::optional<Minimum> other = descend_from_guess(best);
    if (other && is_lower(*other, best)) best = *other;
    improve_by_flips(&best);
    restore(best);
  }
  const Minimum last = descend(rounding_of_cost());
  solution->cost = last.cost;
  solution->converged = last.converged;
  solution->iterations = iterations_;
  for (const GraphTerm& term : state_.terms)
    if (term.mode == 1) solution->failed.push_back(term.id);
}

}  // namespace

void minimise_graph(GraphState* state, GraphSolution* solution) { Minimiser(state).run(solution); }

}  // namespace edgevo
