// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/edge_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "edge_sums.h"
#include "edgevo/alignment/edge_match.h"
#include "edgevo/alignment/projection.h"
#include "edgevo/core/robust.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo {
namespace {

// Levenberg-Marquardt. The damping is relative to the diagonal of the information and changes by factors of
// ten.
constexpr double kFirstDamping = 1e-4;  // the start is nearly right
constexpr double kMinDamping = 1e-6;    // below it a step is a Gauss-Newton step
// Minimum after a rejected step: less would propose almost the same step again.
constexpr double kRefusedDamping = 1e-2;
// A step is then a thousandth of the undamped one: there is no descent.
constexpr double kMaxDamping = 1e3;
// px^-2, added to the information, so that the system is solvable if no edge constrains a direction.
constexpr double kRidge = 1e-9;
// The iteration stops at a rejected step that rotates the image by less.
constexpr double kMinTurnPx = 1e-3;
// The patch alignment stops at a step that moves points by less, since the edge alignment follows.
constexpr double kPatchStepPx = 0.02;
constexpr int kPatchIterations = 12;   // on each level
constexpr int kEdgeIterations = 15;    // on each level
constexpr double kEdgeStepPx = 0.005;  // smaller for edges, which repeat to about 0.05 px
// Cost of a point out of view, in misses: it is no evidence for or against a pose. At no cost, points would
// be pushed out of view; at the cost of a miss, a camera that passes the last near points would be held back
// (lab 2026-11-21_edges_along_the_motion).
constexpr double kOutOfViewShare = 0.5;
// Weight of one standard deviation of the gradient patches relative to an edge residual of one pixel.
constexpr double kPhotometricWeight = 0.5;

// Normal equations of one Gauss-Newton step, with the cost at their linearisation point.
struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  AlignmentStats stats;
};

// Solves (H + lambda diag H) xi = -b; false if the system is not positive definite.
bool solve_step(const NormalEquations& eq, double lambda, Vector6d* xi) {
  Matrix6d H = eq.H;
  H.diagonal() *= 1.0 + lambda;
  H.diagonal().array() += kRidge;
  const Eigen::LDLT<Matrix6d> ldlt(H);
  if (ldlt.info() != Eigen::Success || !ldlt.isPositive()) return false;
  *xi = -ldlt.solve(eq.b);
  return xi->allFinite();
}

// Levenberg-Marquardt for any `linearise(T) -> NormalEquations`; `pixels_per_radian` converts a rotation into
// pixels for the stopping criterion.
template <class Linearise>
NormalEquations minimise(const Linearise& linearise, int max_iterations, double pixels_per_radian,
                         double min_step_px, SE3* T) {
  NormalEquations current = linearise(*T);
  double lambda = kFirstDamping;
  int iteration = 0;
  for (; iteration < max_iterations; ++iteration) {
    Vector6d xi;
    if (!solve_step(current, lambda, &xi)) break;
    const SE3 candidate = SE3::exp(xi) * *T;
    const double predicted_px = std::sqrt(xi.dot(current.H * xi) / std::max(1, current.stats.inliers));
    NormalEquations next = linearise(candidate);
    if (next.stats.cost <= current.stats.cost) {
      *T = candidate;
      current = std::move(next);
      lambda = std::max(kMinDamping, lambda * 0.1);
      if (predicted_px < min_step_px) break;
    } else {
      if (predicted_px < min_step_px || xi.tail<3>().norm() * pixels_per_radian < kMinTurnPx ||
          lambda > kMaxDamping)
        break;
      lambda = std::max(kRefusedDamping, lambda * 10);
    }
  }
  current.stats.iterations = iteration;
  current.stats.information = current.H;
  return current;
}

class EdgeCost {
 public:
  EdgeCost(const FramePyramid& current, const ReferenceCloud& cloud, int level, const AlignmentParams& params)
      : level_(current.levels[level]),
        cloud_(cloud),
        params_(params),
        photometric_(params.photometric && level == 0 && !cloud.gradient_patches.empty()) {
    matched_.reserve(cloud.points.size());
  }

  NormalEquations operator()(const SE3& T_cur_ref) const {
    NormalEquations eq;
    const Eigen::Matrix3d R = T_cur_ref.R();
    const Eigen::Vector3d t = T_cur_ref.translation();
    matched_.clear();
    double cost = 0;
    for (size_t i = 0; i < cloud_.points.size(); ++i) {
      const CloudPoint& point = cloud_.points[i];
      const Projection p = project(level_.pinhole, R, t, point.ray, point.idepth);
      if (!p.valid || !level_.pinhole.contains(p.px, kEdgelessBorder)) continue;
      ++eq.stats.visible;
      match(point, p);
      if (photometric_) cost += add_photometric(cloud_.gradient_patches[i], point, p, &eq);
    }
    eq.stats.inliers = matched_.size();
    const EdgeSums sums = sum_edges(matched_, level_.pinhole, t, miss_cost());
    sums.add_to(&eq.H, &eq.b);
    cost += sums.cost + double(eq.stats.visible - eq.stats.inliers) * miss_cost();
    cost += double(cloud_.points.size() - eq.stats.visible) * kOutOfViewShare * miss_cost();
    eq.stats.cost = cost / std::max<size_t>(1, cloud_.points.size());
    eq.stats.residual_px = eq.stats.inliers > 0 ? std::sqrt(sums.square / eq.stats.inliers) : 0.0;
    return eq;
  }

 private:
  double miss_cost() const { return huber_cost(params_.truncation_normal_px, params_.huber_px); }

  void match(const CloudPoint& point, const Projection& p) const {
    const EdgeMatch match = match_edge(level_, p.px, point.normal, params_);
    if (!match.found) return;
    matched_.append(p.Y, point.idepth, point.idepth_sigma, match.normal, match.residual_px,
                    huber_weight(match.residual_px, params_.huber_px),
                    huber_cost(match.residual_px, params_.huber_px));
  }

  // Eq. (photometricerror) with F the gradient magnitude, normalised patch by patch.
  double add_photometric(const PatchTemplate& patch, const CloudPoint& point, const Projection& p,
                         NormalEquations* eq) const {
    const PatchDifference d =
        compare_patch(level_.gradient_magnitude.view(), patch, float(p.px.x()), float(p.px.y()));
    if (!d.usable) return 0;
    const double rms = std::sqrt(double(d.mean_square));
    const double w = kPhotometricWeight * huber_weight(rms, kPatchHuber);
    const Eigen::Matrix<double, 2, 6> J = pose_jacobian(level_.pinhole, p.Y, point.idepth);
    eq->H.noalias() += w * J.transpose() * patch.information * J;
    eq->b.noalias() += w * J.transpose() * d.gradient;
    return kPhotometricWeight * huber_cost(rms, kPatchHuber);
  }

  const PyramidLevel& level_;
  const ReferenceCloud& cloud_;
  const AlignmentParams& params_;
  bool photometric_;
  mutable MatchedEdges matched_;  // buffer, reused by all evaluations
};

// Each residual in pixels has weight 1, but points of one edge share its error.
constexpr double kVarianceOfResidual = 4;  // px^2
// Sigmas from which a rotation counts as far off.
constexpr double kTurnHuber = 3;
// Sigmas that hardly any image is off by, of a gyro that turns with the camera: one in a hundred.
constexpr double kTurnFarOff = 6;

// Edge cost with priors on the translation and the rotation; null: none.
class CostWithPriors {
 public:
  CostWithPriors(const EdgeCost& edges, const TranslationPrior* prior, const RotationPrior* turn,
                 size_t points)
      : edges_(edges), turn_(turn), points_(double(std::max<size_t>(1, points))) {
    if (!prior) return;
    T_expected_inverse_ = prior->T_expected.inverse();
    weight_ = kVarianceOfResidual * prior->sigma.cwiseAbs2().cwiseInverse();
  }

  NormalEquations operator()(const SE3& T_cur_ref) const {
    NormalEquations eq = edges_(T_cur_ref);
    if (weight_) add_translation(T_cur_ref, &eq);
    if (turn_) add_rotation(T_cur_ref, &eq);
    return eq;
  }

 private:
  // Costs are per point, like the edge cost.
  void add_translation(const SE3& T_cur_ref, NormalEquations* eq) const {
    const Eigen::Vector3d v = (T_cur_ref * T_expected_inverse_).log().head<3>();
    eq->H.diagonal().head<3>() += *weight_;
    eq->b.head<3>() += weight_->cwiseProduct(v);
    eq->stats.cost += 0.5 * weight_->dot(v.cwiseAbs2()) / points_;
  }
  void add_rotation(const SE3& T_cur_ref, NormalEquations* eq) const {
    const Eigen::Matrix3d weight = turn_->weight(T_cur_ref);
    eq->H.bottomRightCorner<3, 3>() += weight;
    eq->b.tail<3>() += weight * turn_->beyond(T_cur_ref);
    eq->stats.cost += turn_->cost(T_cur_ref) / points_;
  }

  const EdgeCost& edges_;
  const RotationPrior* turn_;
  SE3 T_expected_inverse_;
  double points_;
  std::optional<Eigen::Vector3d> weight_;
};

class PatchCost {
 public:
  PatchCost(const FramePyramid& current, const ReferenceCloud& cloud, int level)
      : level_(current.levels[level]), cloud_(cloud), patches_(cloud.patches[level]) {}

  NormalEquations operator()(const SE3& T_cur_ref) const {
    NormalEquations eq;
    const Eigen::Matrix3d R = T_cur_ref.R();
    const Eigen::Vector3d t = T_cur_ref.translation();
    const double miss = huber_cost(std::sqrt(kUnrelatedMeanSquare), kPatchHuber);
    double cost = 0;
    int usable = 0;
    for (size_t i = 0; i < patches_.size(); ++i) {
      if (!patches_[i].usable) continue;
      ++usable;
      const Projection p = project(level_.pinhole, R, t, cloud_.points[i].ray, cloud_.points[i].idepth);
      const PatchDifference d = p.valid ? compare_gray(level_, patches_[i], p.px) : PatchDifference();
      if (!d.usable) {
        cost += miss;
        continue;
      }
      const double rms = std::sqrt(double(d.mean_square));
      const double w = huber_weight(rms, kPatchHuber);
      const Eigen::Matrix<double, 2, 6> J = pose_jacobian(level_.pinhole, p.Y, cloud_.points[i].idepth);
      eq.H.noalias() += w * J.transpose() * patches_[i].information * J;
      eq.b.noalias() += w * J.transpose() * d.gradient;
      cost += huber_cost(rms, kPatchHuber);
      ++eq.stats.inliers;
    }
    eq.stats.visible = usable;
    eq.stats.cost = usable > 0 ? cost / usable : miss;
    return eq;
  }

 private:
  const PyramidLevel& level_;
  const ReferenceCloud& cloud_;
  const PatchTemplates& patches_;
};

}  // namespace

void AlignmentParams::visit_costs(ParamVisitor& v) {
  v.number(kAdvanced, "huber_px", huber_px, 0.1, 10, "Huber width of edge residuals, pixels");
  v.number(kAdvanced, "truncation_normal_px", truncation_normal_px, 0.5, 15,
           "matches beyond this along the edge normal are misses, pixels");
  v.number(kAdvanced, "truncation_tangent_px", truncation_tangent_px, 0.5, 15,
           "matches beyond this along the edge are misses, pixels");
  v.boolean(kAdvanced, "photometric", photometric,
            "add the image-gradient cost of the paper to the finest level (slower)");
}

void AlignmentParams::visit_heuristics(ParamVisitor& v) {
  v.boolean(kExperimental, "verify_patch_start", verify_patch_start,
            "start the edge alignment from the predicted pose where it fits better than the patches' pose");
  v.boolean(kExperimental, "use_median_motion_prior", use_median_motion_prior,
            "require more support for a motion unlike the median of the last ones at constant speed");
}

EdgeResidual edge_residual(const Pinhole& camera, const SE3& T_cur_ref, const Eigen::Vector3d& ray,
                           double idepth, const Eigen::Vector2d& match, const Eigen::Vector2d& normal) {
  const Projection p = project(camera, T_cur_ref.R(), T_cur_ref.translation(), ray, idepth);
  return {normal.dot(p.px - match), normal.transpose() * pose_jacobian(camera, p.Y, idepth)};
}

double align_patches(const FramePyramid& current, const ReferenceCloud& cloud, int coarsest, int finest,
                     SE3* T_cur_ref) {
  double cost = kUnrelatedMeanSquare;
  for (int level = coarsest; level >= finest; --level) {
    const PatchCost patch_cost(current, cloud, level);
    cost = minimise(patch_cost, kPatchIterations, current.levels[level].pinhole.fx, kPatchStepPx, T_cur_ref)
               .stats.cost;
  }
  return cost;
}

double edge_cost(const FramePyramid& current, const ReferenceCloud& cloud, int level,
                 const AlignmentParams& params, const SE3& T_cur_ref) {
  return EdgeCost(current, cloud, level, params)(T_cur_ref).stats.cost;
}

AlignmentStats align_edges(const FramePyramid& current, const ReferenceCloud& cloud, int level,
                           const AlignmentParams& params, SE3* T_cur_ref, const TranslationPrior* prior,
                           const RotationPrior* turn) {
  const EdgeCost edges(current, cloud, level, params);
  const double fx = current.levels[level].pinhole.fx;
  if (!prior && !turn) return minimise(edges, kEdgeIterations, fx, kEdgeStepPx, T_cur_ref).stats;
  return minimise(CostWithPriors(edges, prior, turn, cloud.points.size()), kEdgeIterations, fx, kEdgeStepPx,
                  T_cur_ref)
      .stats;
}

Eigen::Vector3d RotationPrior::beyond(const SE3& T_cur_ref) const {
  return rotation_vector(T_cur_ref.rotation() * R_expected.conjugate());
}

Eigen::Matrix3d RotationPrior::weight(const SE3& T_cur_ref) const {
  const Eigen::Vector3d w = beyond(T_cur_ref);
  return kVarianceOfResidual * huber_weight(std::sqrt(w.dot(information * w)), kTurnHuber) * information;
}

Eigen::Matrix3d RotationPrior::covariance(const SE3& T_cur_ref) const {
  return kVarianceOfResidual * weight(T_cur_ref).inverse();
}

bool RotationPrior::is_far_off(const Eigen::Quaterniond& R_cur_ref, const Eigen::Matrix3d& covariance) const {
  const Eigen::Vector3d w = rotation_vector(R_cur_ref * R_expected.conjugate());
  return w.dot((information.inverse() + covariance).inverse() * w) > kTurnFarOff * kTurnFarOff;
}

double RotationPrior::cost(const SE3& T_cur_ref) const {
  const Eigen::Vector3d w = beyond(T_cur_ref);
  return kVarianceOfResidual * huber_cost(std::sqrt(w.dot(information * w)), kTurnHuber);
}

}  // namespace edgevo
