// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/tracker.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>

#include "edgevo/alignment/rotation_search.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

double median_depth(const ReferenceCloud& cloud) {
  std::vector<double> depths;
  depths.reserve(cloud.points.size());
  for (const CloudPoint& p : cloud.points) depths.push_back(1.0 / p.idepth);
  return depths.empty() ? 1.0 : median(std::move(depths));
}

// Directions whose standard deviation exceeds `weak_sigma`; translation is measured in median depths.
std::vector<Vector6d> find_weak_directions(const Matrix6d& covariance, double depth, double weak_sigma) {
  Vector6d per_unit;
  per_unit << 1 / depth, 1 / depth, 1 / depth, 1, 1, 1;
  const Matrix6d scaled = per_unit.asDiagonal() * covariance * per_unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scaled);
  std::vector<Vector6d> weak;
  for (int i = 0; i < 6; ++i)
    if (!(eigen.eigenvalues()[i] <= weak_sigma * weak_sigma)) weak.push_back(eigen.eigenvectors().col(i));
  return weak;
}

std::string format(const char* pattern, double a, double b) {
  char text[120];
  std::snprintf(text, sizeof text, pattern, a, b);
  return text;
}

// Why a frame of this quality has no pose or a weak one; empty where it is good.
std::string reason_of(TrackingQuality quality, const PoseCandidate& pose, const AlignmentParams& params) {
  const double share = pose.evidence.inlier_share;
  switch (quality) {
    case TrackingQuality::kDiverged:
      return "alignment diverged";
    case TrackingQuality::kFewPoints:
      return format("only %.0f map points in view, %.0f are needed", pose.stats.visible, params.min_visible);
    case TrackingQuality::kUnsupported:
      return format("inlier share %.2f is below %.2f", share, params.lost_share);
    case TrackingQuality::kWeak:
      return format("inlier share %.2f is below %.2f", share, params.degraded_share);
    case TrackingQuality::kGood:
      break;
  }
  return {};
}

TrackingState state_of(TrackingQuality quality) {
  if (is_lost(quality)) return TrackingState::kLost;
  return quality == TrackingQuality::kGood ? TrackingState::kTracking : TrackingState::kDegraded;
}

void set_status(const AlignmentParams& params, TrackResult* r) {
  const TrackingQuality quality = classify(*r, params);
  r->status = state_of(quality);
  r->reason = reason_of(quality, *r, params);
  if (quality == TrackingQuality::kGood && !r->weak_directions.empty()) {
    r->status = TrackingState::kDegraded;
    r->reason = format("%.0f poorly observed direction(s)%.0s", double(r->weak_directions.size()), 0.0);
  }
}

std::vector<PoseHypothesis> as_hypotheses(const std::vector<SE3>& starts) {
  std::vector<PoseHypothesis> hypotheses;
  for (const SE3& start : starts) hypotheses.push_back({start});
  return hypotheses;
}

}  // namespace

TrackResult assess(const FramePyramid& current, const ReferenceCloud& cloud, const PoseCandidate& pose,
                   const AlignmentParams& params) {
  TrackResult r;
  static_cast<PoseCandidate&>(r) = pose;
  if (r.T_cur_ref.is_finite())
    r.covariance = pose_covariance(pose_equations(current, cloud, r.T_cur_ref, params));
  r.weak_directions = find_weak_directions(r.covariance, median_depth(cloud), params.weak_sigma);
  set_status(params, &r);
  return r;
}

std::vector<SE3> motion_hypotheses(const SE3& T_last_ref, const SE3& T_last_before) {
  const Vector6d velocity = T_last_before.log();
  Vector6d rotation = velocity;
  rotation.head<3>().setZero();
  return {T_last_before * T_last_ref, T_last_ref, SE3::exp(0.5 * velocity) * T_last_ref,
          SE3::exp(2.0 * velocity) * T_last_ref, SE3::exp(rotation) * T_last_ref};
}

Proposer propose_starts(std::vector<SE3> starts, const PoseScorer& scorer) {
  return {ProposerKind::kStarts, [&scorer](const PoseCandidate& best) { return !scorer.fits(best); },
          [starts = std::move(starts)] { return as_hypotheses(starts); }};
}

Proposer propose_rotations(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_predicted,
                           const PoseScorer& scorer) {
  return {ProposerKind::kRotations, [&scorer](const PoseCandidate& best) { return !scorer.fits(best); },
          [&, T_predicted] { return as_hypotheses(search_rotation(current, cloud, T_predicted)); }};
}

TrackResult track(const FramePyramid& current, const ReferenceCloud& cloud, const std::vector<SE3>& starts,
                  const AlignmentParams& params) {
  const PoseScorer scorer(params);
  const std::vector<Proposer> proposers{propose_starts(starts, scorer),
                                        propose_rotations(current, cloud, starts.front(), scorer)};
  return assess(current, cloud, choose(proposers, current, cloud, scorer, params).pose, params);
}

}  // namespace edgevo
