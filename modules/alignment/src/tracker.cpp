#include "edgevo/alignment/tracker.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

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

// Edges are aligned on two levels, where the pyramid has so many with edges.
int coarsest_edge_level(const FramePyramid& pyramid) {
  int levels = 0;
  while (levels < int(pyramid.levels.size()) && !pyramid.levels[levels].gradient_magnitude.empty()) ++levels;
  return std::min(levels, 2) - 1;
}

// The edges alone, from coarse to fine.
void align_all_edges(const FramePyramid& current, const ReferenceCloud& cloud, const AlignmentParams& params, TrackResult* result,
                     const TranslationPrior* prior = nullptr) {
  for (int level = coarsest_edge_level(current); level >= 0; --level)
    result->stats = align_edges(current, cloud, level, params, &result->T_cur_ref, prior);
  if (result->T_cur_ref.is_finite()) result->evidence = weigh_evidence(current, cloud, result->T_cur_ref, params);
}

TrackResult align_from(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& start,
                       const AlignmentParams& params) {
  TrackResult result;
  result.T_cur_ref = start;
  const int coarsest = int(current.levels.size()) - 1;
  align_patches(current, cloud, coarsest, std::min(params.patch_finest_level, coarsest), params, &result.T_cur_ref);
  const int edge_level = coarsest_edge_level(current);
  // Glare and shadows lead gray levels astray where the edges of the scene run along the motion: the edges choose where to go on from.
  if (edge_cost(current, cloud, edge_level, params, start) < edge_cost(current, cloud, edge_level, params, result.T_cur_ref))
    result.T_cur_ref = start;
  align_all_edges(current, cloud, params, &result);
  return result;
}

bool is_good(const TrackResult& r, const AlignmentParams& params) {
  return r.stats.visible >= params.min_visible && r.evidence.inlier_share >= params.degraded_share;
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

void judge(const AlignmentParams& params, TrackResult* r) {
  const double share = r->evidence.inlier_share;
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
  } else if (!r->weak_directions.empty()) {
    r->verdict = TrackingState::kDegraded;
    r->reason = format("%.0f poorly observed direction(s)%.0s", double(r->weak_directions.size()), 0.0);
  } else {
    r->verdict = TrackingState::kTracking;
  }
}

// Covariance and verdict.
void finish(const FramePyramid& current, const ReferenceCloud& cloud, const AlignmentParams& params, TrackResult* r) {
  if (r->T_cur_ref.is_finite()) r->covariance = pose_covariance(pose_equations(current, cloud, r->T_cur_ref, params));
  r->weak_directions = find_weak_directions(r->covariance, median_depth(cloud), params.weak_sigma);
  judge(params, r);
}

}  // namespace

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
  const auto try_starts = [&](const std::vector<SE3>& from) {
    for (const SE3& start : from) {
      TrackResult r = align_from(current, cloud, start, params);
      if (++tried == 1 || support(r.evidence, params) > support(best.evidence, params)) best = std::move(r);
      if (is_good(best, params)) return;
    }
  };
  try_starts(starts);
  if (!is_good(best, params)) try_starts(search_rotation(current, cloud, starts.front(), params));
  best.starts_tried = tried;
  finish(current, cloud, params, &best);
  return best;
}

TrackResult track_near(const FramePyramid& current, const ReferenceCloud& cloud, const TranslationPrior& prior, const AlignmentParams& params) {
  TrackResult result;
  result.T_cur_ref = prior.T_expected;
  result.starts_tried = 1;
  align_all_edges(current, cloud, params, &result, &prior);
  finish(current, cloud, params, &result);
  return result;
}

TrackResult track_along(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_cur_ref, const AlignmentParams& params) {
  constexpr int kSteps = 6;  // to either side: neighbours differ by an eighth of the length
  TrackResult result;
  result.starts_tried = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int i = -kSteps; i <= kSteps; ++i) {
    const SE3 start(T_cur_ref.rotation(), std::exp2(double(i) / kSteps) * T_cur_ref.translation());
    const double cost = edge_cost(current, cloud, coarsest_edge_level(current), params, start);
    if (cost < least) least = cost, result.T_cur_ref = start;
  }
  align_all_edges(current, cloud, params, &result);
  finish(current, cloud, params, &result);
  return result;
}

TrackResult track_again(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_cur_ref, const AlignmentParams& params) {
  TrackResult result;
  result.T_cur_ref = T_cur_ref;
  result.starts_tried = 1;
  result.stats = align_edges(current, cloud, 0, params, &result.T_cur_ref);
  if (result.T_cur_ref.is_finite()) result.evidence = weigh_evidence(current, cloud, result.T_cur_ref, params);
  finish(current, cloud, params, &result);
  return result;
}

}  // namespace edgevo
