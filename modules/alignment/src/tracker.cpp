// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/tracker.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "edgevo/core/order_statistics.h"
#include "rotation_search.h"

namespace edgevo {
namespace {

double median_depth(const ReferenceCloud& cloud) {
  std::vector<double> depths;
  depths.reserve(cloud.points.size());
  for (const CloudPoint& p : cloud.points) depths.push_back(1.0 / p.idepth);
  return depths.empty() ? 1.0 : median(std::move(depths));
}

// Principal directions of the covariance, with translation measured in `depth`.
void find_directions(double depth, TrackResult* r) {
  Vector6d per_unit;
  per_unit << 1 / depth, 1 / depth, 1 / depth, 1, 1, 1;
  const Matrix6d scaled = per_unit.asDiagonal() * r->covariance * per_unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scaled);
  r->directions = eigen.eigenvectors();
  // Rounding may leave the smallest variance below zero; NaN stays NaN.
  for (int i = 0; i < 6; ++i) {
    const double variance = eigen.eigenvalues()[i];
    r->sigmas[i] = variance < 0 ? 0.0 : std::sqrt(variance);
  }
}

std::vector<PoseHypothesis> as_hypotheses(const std::vector<SE3>& starts,
                                          const std::optional<RotationPrior>& turn = std::nullopt) {
  std::vector<PoseHypothesis> hypotheses;
  for (const SE3& start : starts) {
    hypotheses.push_back({start});
    hypotheses.back().turn = turn;
  }
  return hypotheses;
}

}  // namespace

TrackResult assess(const FramePyramid& current, const ReferenceCloud& cloud, const PoseCandidate& pose,
                   const AlignmentParams& params) {
  TrackResult r;
  static_cast<PoseCandidate&>(r) = pose;
  const double depth = median_depth(cloud);
  if (r.T_cur_ref.is_finite()) {
    const std::vector<PoseEquation> equations = pose_equations(current, cloud, r.T_cur_ref, params);
    r.covariance = pose_covariance(equations);
    r.smooth = correlated_residual(equations);
    r.correlated_px2 = r.smooth.variance_px2();
    r.zoom = image_zoom(equations, 0.5 * current.finest().pinhole.width, depth);
  }
  find_directions(depth, &r);
  return r;
}

std::vector<SE3> motion_hypotheses(const SE3& T_last_ref, const SE3& T_last_before) {
  const Vector6d velocity = T_last_before.log();
  Vector6d rotation = velocity;
  rotation.head<3>().setZero();
  return {T_last_before * T_last_ref, T_last_ref, SE3::exp(0.5 * velocity) * T_last_ref,
          SE3::exp(2.0 * velocity) * T_last_ref, SE3::exp(rotation) * T_last_ref};
}

Proposer propose_starts(std::vector<SE3> starts, const PoseScorer& scorer,
                        const std::optional<RotationPrior>& turn) {
  return {ProposerKind::kStarts, [&scorer](const PoseCandidate& best) { return !scorer.fits(best); },
          [starts = std::move(starts), turn] { return as_hypotheses(starts, turn); }};
}

Proposer propose_rotations(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_predicted,
                           const PoseScorer& scorer) {
  return {ProposerKind::kRotations, [&scorer](const PoseCandidate& best) { return !scorer.fits(best); },
          [&, T_predicted] { return as_hypotheses(search_rotation(current, cloud, T_predicted)); }};
}

TrackResult track(const FramePyramid& current, const ReferenceCloud& cloud, const std::vector<SE3>& starts,
                  const PoseScorer& scorer, const AlignmentParams& params) {
  const std::vector<Proposer> proposers{propose_starts(starts, scorer),
                                        propose_rotations(current, cloud, starts.front(), scorer)};
  return assess(current, cloud, choose(proposers, current, cloud, scorer, params).pose, params);
}

}  // namespace edgevo
