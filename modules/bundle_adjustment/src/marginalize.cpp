// SPDX-License-Identifier: BSD-3-Clause
// Marginalisation of a keyframe into a prior on the remaining poses.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "edgevo/core/error.h"
#include "normal_equations.h"
#include "prior.h"
#include "residuals/corner_residual.h"
#include "residuals/turn_residual.h"

namespace edgevo {
namespace {

using namespace ba;

// E(xi) = 1/2 xi^T H xi + b^T xi + constant over all poses of the problem, 6 rows per pose.
struct Quadratic {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
  double constant = 0;
};

std::vector<bool> points_to_drop(const BaProblem& problem, int pose) {
  std::vector<bool> drop(problem.points.size());
  for (std::size_t i = 0; i < drop.size(); ++i) drop[i] = problem.points[i].host == pose;
  for (const BaObservation& o : problem.observations)
    if (o.target == pose) drop[o.point] = true;
  return drop;
}

// Information of the dropped points, with depths eliminated, in perturbations delta of the current poses.
Quadratic eliminate_points(const BaProblem& problem, const BaOptions& options,
                           const std::vector<bool>& drop) {
  const State state = initial_state(problem, options.min_idepth);
  std::vector<bool> keep(drop.size());
  for (std::size_t i = 0; i < drop.size(); ++i) keep[i] = !drop[i];
  const PackedProblem packed = pack_problem(problem, state, &keep);
  NormalEquations equations;
  NormalEquationsBuilder(packed, options.huber_width).build(state, &equations);
  Quadratic q{equations.H - equations.S, equations.b - equations.s, equations.cost};
  for (std::size_t i = 0; i < packed.points.size(); ++i) {
    const double information = equations.idepth_information[i], gradient = equations.idepth_gradient[i];
    if (!packed.points[i].fixed && information > kMinIdepthInformation)
      q.constant -= 0.5 * gradient * gradient / information;
  }
  return q;
}

// Information of the corners and turns that a pose shares with others, in the same perturbations.
void add_pairs(const BaProblem& problem, int pose, const BaOptions& options, Quadratic* q) {
  std::vector<BaCornerPair> shared;
  for (const BaCornerPair& c : problem.corners)
    if (c.from == pose || c.to == pose) shared.push_back(c);
  std::vector<SE3> poses;
  for (const BaPose& p : problem.poses) poses.push_back(p.T_cam_world);
  q->constant += CornerTerm(problem.pinhole, shared, options.huber_width).add(poses, &q->H, &q->b);
  std::vector<BaTurn> turns;
  for (const BaTurn& t : problem.turns)
    if (t.from == pose || t.to == pose) turns.push_back(t);
  q->constant += TurnTerm(turns, options.huber_width).add(poses, &q->H, &q->b);
}

// From perturbations delta of the current poses to xi = log(T linearization^-1):  delta = J_l(xi_now) (xi -
// xi_now).
void move_linearization(const PriorTerm& prior, const Eigen::VectorXd& xi_prior, Quadratic* q) {
  Eigen::VectorXd xi_now = Eigen::VectorXd::Zero(q->b.size()), gradient = q->b;
  for (std::size_t i = 0; i < prior.pose_index().size(); ++i) {
    const int row = 6 * prior.pose_index()[i];
    xi_now.segment<6>(row) = xi_prior.segment<6>(6 * i);
    // J is block diagonal: J^T H J row by row, column by column.
    const Matrix6d J = left_jacobian(xi_prior.segment<6>(6 * i));
    q->H.middleRows<6>(row) = (J.transpose() * q->H.middleRows<6>(row)).eval();
    q->H.middleCols<6>(row) = (q->H.middleCols<6>(row) * J).eval();
    gradient.segment<6>(row) = J.transpose() * q->b.segment<6>(row);
  }
  q->constant += 0.5 * xi_now.dot(q->H * xi_now) - gradient.dot(xi_now);
  q->b = gradient - q->H * xi_now;
}

void add_prior(const BaPrior& prior, const std::vector<int>& pose_index, Quadratic* q) {
  q->constant += prior.constant;
  for (std::size_t i = 0; i < pose_index.size(); ++i) {
    const int row = 6 * pose_index[i];
    q->b.segment<6>(row) += prior.b.segment<6>(6 * i);
    for (std::size_t j = 0; j < pose_index.size(); ++j)
      q->H.block<6, 6>(row, 6 * pose_index[j]) += prior.H.block<6, 6>(6 * i, 6 * j);
  }
}

// Conditions on the known pose `row / 6`, whose displacement is `xi`.
void condition(const Vector6d& xi, int row, Quadratic* q) {
  q->constant += 0.5 * xi.dot(q->H.block<6, 6>(row, row) * xi) + q->b.segment<6>(row).dot(xi);
  q->b += q->H.middleCols<6>(row) * xi;
}

// Inverse on the range of a positive semidefinite 6x6 matrix. Translations and rotations differ in unit,
// hence the scaling to a unit diagonal; anything below kNothing is then rounding.
Matrix6d pseudo_inverse(const Matrix6d& M) {
  constexpr double kNothing = 1e-12;
  const Vector6d scale = M.diagonal().cwiseMax(0).cwiseSqrt().cwiseMax(kNothing).cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scale.asDiagonal() * M * scale.asDiagonal());
  Vector6d inverse;
  for (int i = 0; i < 6; ++i)
    inverse[i] = eigen.eigenvalues()[i] > kNothing ? 1.0 / eigen.eigenvalues()[i] : 0.0;
  return scale.asDiagonal() * eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose() *
         scale.asDiagonal();
}

// Minimises over pose `row / 6`; its rows and columns are meaningless afterwards.
void eliminate_pose(int row, Quadratic* q) {
  const Eigen::Matrix<double, 6, Eigen::Dynamic> coupling = q->H.middleRows<6>(row);
  const Vector6d b = q->b.segment<6>(row);
  const Matrix6d inverse = pseudo_inverse(q->H.block<6, 6>(row, row));
  q->H -= coupling.transpose() * inverse * coupling;
  q->b -= coupling.transpose() * (inverse * b);
  q->constant -= 0.5 * b.dot(inverse * b);
}

// Poses of the new prior: free, not the marginalised one, and with some information about them.
std::vector<int> poses_to_keep(const BaProblem& problem, int leaving, const Quadratic& q) {
  std::vector<int> keep;
  for (int i = 0; i < static_cast<int>(problem.poses.size()); ++i)
    if (i != leaving && !problem.poses[i].fixed && !q.H.middleRows<6>(6 * i).isZero(0.0)) keep.push_back(i);
  return keep;
}

// Elimination subtracts large numbers, whose rounding can leave a weak direction (the scale, or where the
// window is in the world) with a negative curvature: the prior then has no minimum, and an adjustment runs
// away along it. Such directions, and those no further from zero, are not known. `before`: curvatures before
// the elimination, the measure of its rounding. Cost: a Cholesky decomposition where all is well.
void bound_below(const Eigen::VectorXd& before, BaPrior* prior) {
  constexpr double kRounding = 1e-11;  // share of `before`: 1e-16 a subtraction, and more where it is weak
  constexpr double kTimesNegative = 10;
  if (prior->H.size() == 0) return;
  const Eigen::VectorXd unit = before.cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt();
  const Eigen::VectorXd per_unit = (before.array() > 0).select(unit.cwiseInverse(), 0.0);
  const Eigen::MatrixXd H = per_unit.asDiagonal() * prior->H * per_unit.asDiagonal();
  if (H.llt().info() == Eigen::Success) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(H);
  const Eigen::ArrayXd curvature = eigen.eigenvalues().array();
  const auto is_known = curvature > std::max(kTimesNegative * -curvature[0], kRounding);
  const Eigen::VectorXd b = eigen.eigenvectors().transpose() * per_unit.cwiseProduct(prior->b);
  const Eigen::VectorXd known_H = is_known.select(curvature, 0.0), known_b = is_known.select(b.array(), 0.0);
  const Eigen::MatrixXd back = unit.asDiagonal() * eigen.eigenvectors();
  prior->H = back * known_H.asDiagonal() * back.transpose();
  prior->b = back * known_b;
  const double depth = 0.5 * is_known.select(known_b.array().square() / curvature, 0.0).sum();
  prior->constant = std::max(prior->constant, depth);
}

BaPrior extract(const BaProblem& problem, const std::vector<int>& keep, const PriorTerm& old,
                const Eigen::VectorXd& before, const Quadratic& q) {
  const auto n = static_cast<Eigen::Index>(keep.size());
  Eigen::VectorXd before_kept(6 * n);
  BaPrior prior;
  prior.H.resize(6 * n, 6 * n);
  prior.b.resize(6 * n);
  prior.constant = q.constant;
  for (Eigen::Index i = 0; i < n; ++i) {
    const int pose = keep[i];
    const auto found = std::find(old.pose_index().begin(), old.pose_index().end(), pose);
    const bool linearised = found != old.pose_index().end();
    prior.pose_ids.push_back(problem.pose_ids[pose]);
    prior.linearization.push_back(linearised ? problem.prior->linearization[found - old.pose_index().begin()]
                                             : problem.poses[pose].T_cam_world);
    prior.b.segment<6>(6 * i) = q.b.segment<6>(6 * pose);
    before_kept.segment<6>(6 * i) = before.segment<6>(6 * pose);
    for (Eigen::Index j = 0; j < n; ++j)
      prior.H.block<6, 6>(6 * i, 6 * j) = q.H.block<6, 6>(6 * pose, 6 * keep[j]);
  }
  prior.H = (0.5 * (prior.H + prior.H.transpose())).eval();
  bound_below(before_kept, &prior);
  return prior;
}

// Whether a quadratic constrains a free pose at all.
bool has_information(const BaProblem& problem, const Quadratic& q, int pose) {
  return !problem.poses[pose].fixed && !q.H.middleRows<6>(6 * pose).isZero(0.0);
}

// Covariance of xi of the last `wanted` of `poses`, 6 rows a pose; nothing if the information has no finite
// inverse. With H = L L^T, the last block of H^-1 is that of (L_ww L_ww^T)^-1. Scaled to a unit diagonal,
// since translations and rotations differ in unit.
std::optional<Eigen::MatrixXd> covariance_of_last(const std::vector<int>& poses, Eigen::Index wanted,
                                                  const Quadratic& q) {
  const auto n = static_cast<Eigen::Index>(poses.size());
  Eigen::MatrixXd H(6 * n, 6 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      H.block<6, 6>(6 * i, 6 * j) = q.H.block<6, 6>(6 * poses[i], 6 * poses[j]);
  const Eigen::VectorXd scale = H.diagonal().cwiseSqrt().cwiseInverse();
  H = scale.asDiagonal() * H * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> llt(H);
  if (llt.info() != Eigen::Success) return std::nullopt;
  Eigen::MatrixXd root = Eigen::MatrixXd::Identity(6 * wanted, 6 * wanted);
  llt.matrixLLT().bottomRightCorner(6 * wanted, 6 * wanted).triangularView<Eigen::Lower>().solveInPlace(root);
  root = root * scale.tail(6 * wanted).asDiagonal();
  const Eigen::MatrixXd covariance = root.transpose() * root;
  if (!covariance.allFinite()) return std::nullopt;
  return covariance;
}

// d xi / d delta, inverted: perturbations of the current pose from xi = log(T linearization^-1), as in
// move_linearization().
Matrix6d perturbation_of_xi(const PriorTerm& old, const Eigen::VectorXd& xi_prior, int pose) {
  const auto found = std::find(old.pose_index().begin(), old.pose_index().end(), pose);
  if (found == old.pose_index().end()) return Matrix6d::Identity();
  return left_jacobian(xi_prior.segment<6>(6 * (found - old.pose_index().begin())));
}

int find_pose(const BaProblem& problem, int pose_id) {
  const auto found = std::find(problem.pose_ids.begin(), problem.pose_ids.end(), pose_id);
  if (found == problem.pose_ids.end())
    throw InputError("bundle adjustment", "no pose is named " + std::to_string(pose_id),
                     "name poses in pose_ids");
  return static_cast<int>(found - problem.pose_ids.begin());
}

// Poses with information: first those of no interest, then `wanted`, whose number is returned.
Eigen::Index order_poses(const BaProblem& problem, const Quadratic& q, const std::vector<int>& wanted,
                         std::vector<int>* poses) {
  const auto is_wanted = [&](int i) { return std::find(wanted.begin(), wanted.end(), i) != wanted.end(); };
  for (int i = 0; i < static_cast<int>(problem.poses.size()); ++i)
    if (!is_wanted(i) && has_information(problem, q, i)) poses->push_back(i);
  const auto others = static_cast<Eigen::Index>(poses->size());
  for (const int i : wanted)
    if (has_information(problem, q, i)) poses->push_back(i);
  return static_cast<Eigen::Index>(poses->size()) - others;
}

// Fills the covariances. T_leaving_other moves by delta_leaving - Ad(T_leaving_other) delta_other, and a
// fixed pose by nothing.
void fill(const BaProblem& problem, int leaving, const PriorTerm& old, const Eigen::VectorXd& xi_prior,
          const Quadratic& q, std::vector<RelativeCovariance>* relative) {
  std::vector<int> wanted{leaving}, poses;
  for (const RelativeCovariance& r : *relative) wanted.push_back(find_pose(problem, r.pose_id));
  const Eigen::Index known = order_poses(problem, q, wanted, &poses);
  if (known == 0) return;
  const std::optional<Eigen::MatrixXd> covariance = covariance_of_last(poses, known, q);
  if (!covariance) return;
  for (RelativeCovariance& r : *relative) {
    const int other = find_pose(problem, r.pose_id);
    const Matrix6d Ad =
        (problem.poses[leaving].T_cam_world * problem.poses[other].T_cam_world.inverse()).adjoint();
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, 6 * known);
    bool is_known = true;
    for (const int pose : {leaving, other}) {
      if (problem.poses[pose].fixed) continue;
      const auto at = std::find(poses.end() - known, poses.end(), pose);
      is_known &= at != poses.end();
      if (!is_known) break;
      const Matrix6d to_delta = perturbation_of_xi(old, xi_prior, pose);
      J.middleCols<6>(6 * (at - (poses.end() - known))) =
          pose == leaving ? to_delta : Matrix6d(-Ad * to_delta);
    }
    if (is_known) r.covariance = J * *covariance * J.transpose();
  }
}

}  // namespace

BaPrior marginalize(const BaProblem& problem, int pose_id, const BaOptions& options,
                    std::vector<bool>* drop_points, std::vector<RelativeCovariance>* relative) {
  check_problem(problem);
  const int leaving = find_pose(problem, pose_id);
  *drop_points = points_to_drop(problem, leaving);
  if (!is_finite(problem)) return {};

  const PriorTerm old(problem);
  std::vector<SE3> poses;
  for (const BaPose& pose : problem.poses) poses.push_back(pose.T_cam_world);
  const Eigen::VectorXd xi_prior = old.displacement(poses);

  Quadratic q = eliminate_points(problem, options, *drop_points);
  add_pairs(problem, leaving, options, &q);
  move_linearization(old, xi_prior, &q);
  if (!old.empty()) add_prior(*problem.prior, old.pose_index(), &q);
  // A fixed pose in the old prior keeps its current value, which may differ from the linearisation point.
  for (std::size_t i = 0; i < old.pose_index().size(); ++i)
    if (problem.poses[old.pose_index()[i]].fixed)
      condition(xi_prior.segment<6>(6 * i), 6 * old.pose_index()[i], &q);

  if (relative) fill(problem, leaving, old, xi_prior, q, relative);
  const std::vector<int> keep = poses_to_keep(problem, leaving, q);
  const Eigen::VectorXd before = q.H.diagonal();
  if (!problem.poses[leaving].fixed) eliminate_pose(6 * leaving, &q);
  return extract(problem, keep, old, before, q);
}

}  // namespace edgevo
