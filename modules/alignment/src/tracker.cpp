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

// Directions whose standard deviation, translation measured in median depths, exceeds params.weak_sigma.
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

void give_verdict(const AlignmentParams& params, TrackResult* r) {
  const TrackingQuality quality = classify(*r, params);
  r->verdict = state_of(quality);
  r->reason = reason_of(quality, *r, params);
  if (quality == TrackingQuality::kGood && !r->weak_directions.empty()) {
    r->verdict = TrackingState::kDegraded;
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
  give_verdict(params, &r);
  return r;
}

std::vector<SE3> motion_hypotheses(const SE3& T_last_ref, const SE3& T_last_before) {
  const Vector6d velocity = T_last_before.log();
  Vector6d rotation = velocity;
  rotation.head<3>().setZero();
  return {T_last_before * T_last_ref, T_last_ref, SE3::exp(0.5 * velocity) * T_last_ref,
          SE3::exp(2.0 * velocity) * T_last_ref, SE3::exp(rotation) * T_last_ref};
}

Proposer propose_starts(std::vector<SE3> starts, const PoseJudge& judge) {
  return {ProposerKind::kStarts, [&judge](const PoseCandidate& best) { return !judge.fits(best); },
          [starts = std::move(starts)] { return as_hypotheses(starts); }};
}

Proposer propose_rotations(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_predicted,
                           const PoseJudge& judge) {
  return {ProposerKind::kRotations, [&judge](const PoseCandidate& best) { return !judge.fits(best); },
          [&, T_predicted] { return as_hypotheses(search_rotation(current, cloud, T_predicted)); }};
}

TrackResult track(const FramePyramid& current, const ReferenceCloud& cloud, const std::vector<SE3>& starts,
                  const AlignmentParams& params) {
  const PoseJudge judge(params);
  const std::vector<Proposer> proposers{propose_starts(starts, judge),
                                        propose_rotations(current, cloud, starts.front(), judge)};
  return assess(current, cloud, choose(proposers, current, cloud, judge, params).pose, params);
}

}  // namespace edgevo
