#include "edgevo/alignment/tracker.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace edgevo {
namespace {

double median_depth(const ReferenceCloud& cloud) {
  std::vector<double> depths;
  depths.reserve(cloud.points.size());
  for (const CloudPoint& p : cloud.points) depths.push_back(1.0 / p.idepth);
  if (depths.empty()) return 1.0;
  std::nth_element(depths.begin(), depths.begin() + depths.size() / 2, depths.end());
  return depths[depths.size() / 2];
}

TrackResult align_from(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& start,
                       const AlignmentParams& params) {
  TrackResult result;
  result.T_cur_ref = start;
  const int coarsest = int(current.levels.size()) - 1;
  align_patches(current, cloud, coarsest, std::min(params.patch_finest_level, coarsest), params, &result.T_cur_ref);
  int edge_levels = 0;
  while (edge_levels < int(current.levels.size()) && !current.levels[edge_levels].gradient_magnitude.empty()) ++edge_levels;
  for (int level = std::min(edge_levels, 2) - 1; level >= 0; --level)
    result.stats = align_edges(current, cloud, level, params, &result.T_cur_ref);
  return result;
}

bool is_good(const TrackResult& r, const AlignmentParams& params) {
  return r.stats.visible >= params.min_visible && r.stats.inlier_share() >= params.degraded_share &&
         r.stats.residual_px <= params.degraded_residual_px;
}

// Directions whose standard deviation, translation measured in median depths, exceeds params.weak_sigma.
std::vector<Vector6d> find_weak_directions(const Matrix6d& information, double residual_px, double depth, double weak_sigma) {
  Vector6d unit;
  unit << depth, depth, depth, 1, 1, 1;
  const Matrix6d scaled = unit.asDiagonal() * information * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scaled);
  const double min_eigenvalue = std::pow(std::max(residual_px, 0.1) / weak_sigma, 2);
  std::vector<Vector6d> weak;
  for (int i = 0; i < 6; ++i)
    if (!(eigen.eigenvalues()[i] >= min_eigenvalue)) weak.push_back(eigen.eigenvectors().col(i));
  return weak;
}

std::string format(const char* pattern, double a, double b) {
  char text[120];
  std::snprintf(text, sizeof text, pattern, a, b);
  return text;
}

void judge(const AlignmentParams& params, TrackResult* r) {
  const double share = r->stats.inlier_share();
  r->verdict = TrackingState::kLost;
  if (!r->T_cur_ref.is_finite()) {
    r->reason = "alignment diverged";
  } else if (r->stats.visible < params.min_visible) {
    r->reason = format("only %.0f map points in view, %.0f are needed", r->stats.visible, params.min_visible);
  } else if (share < params.lost_share) {
    r->reason = format("inlier share %.2f is below %.2f", share, params.lost_share);
  } else if (share < params.degraded_share) {
    r->verdict = TrackingState::kDegraded;
    r->reason = format("inlier share %.2f is below %.2f", share, params.degraded_share);
  } else if (r->stats.residual_px > params.degraded_residual_px) {
    r->verdict = TrackingState::kDegraded;
    r->reason = format("residual %.2f px is above %.2f px", r->stats.residual_px, params.degraded_residual_px);
  } else if (!r->weak_directions.empty()) {
    r->verdict = TrackingState::kDegraded;
    r->reason = format("%.0f poorly observed direction(s)%.0s", double(r->weak_directions.size()), 0.0);
  } else {
    r->verdict = TrackingState::kTracking;
  }
}

}  // namespace

Matrix6d pose_covariance(const AlignmentStats& stats) {
  Matrix6d H = stats.information;
  H.diagonal().array() += 1e-9;
  const double sigma_r = std::max(stats.residual_px, 0.1);
  return H.inverse() * (sigma_r * sigma_r);  // Eq. (poseuncertainty)
}

std::vector<SE3> motion_hypotheses(const SE3& T_last_ref, const SE3& T_last_before) {
  const Vector6d velocity = T_last_before.log();
  Vector6d rotation = velocity;
  rotation.head<3>().setZero();
  return {T_last_before * T_last_ref, T_last_ref, SE3::exp(0.5 * velocity) * T_last_ref,
          SE3::exp(2.0 * velocity) * T_last_ref, SE3::exp(rotation) * T_last_ref};
}

TrackResult track(const FramePyramid& current, const ReferenceCloud& cloud, const std::vector<SE3>& starts,
                  const AlignmentParams& params) {
  TrackResult best;
  int tried = 0;
  for (const SE3& start : starts) {
    TrackResult r = align_from(current, cloud, start, params);
    ++tried;
    if (tried == 1 || (r.stats.inliers > best.stats.inliers && r.stats.inlier_share() > best.stats.inlier_share()))
      best = std::move(r);
    if (is_good(best, params)) break;
  }
  best.starts_tried = tried;
  best.covariance = pose_covariance(best.stats);
  best.weak_directions =
      find_weak_directions(best.stats.information, best.stats.residual_px, median_depth(cloud), params.weak_sigma);
  judge(params, &best);
  return best;
}

}  // namespace edgevo
