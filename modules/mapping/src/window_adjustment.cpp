// The window's bundle adjustment: the problem made of the keyframes and their matches, and what becomes of
// both after a solve.
#include <algorithm>
#include <cmath>

#include "edgevo/core/rule.h"
#include "edgevo/mapping/window.h"

namespace edgevo {
namespace {

// Keyframes that should have seen a point and did not, beyond which it is dropped: a quarter of the window,
// an occlusion or two.
constexpr int kMaxMisses = 3;
// Standard deviations of a match, beyond which it is dropped after the last adjustment: hardly ever chance.
constexpr double kDropSigmas = 4.0;
constexpr double kCornerSigmaPx = 0.5;  // one standard deviation of a corner
// Share of the cost whose decrease ends an adjustment: what is left after it is below the noise of the
// matches. A fifth of the time less than with 1e-4, at the same errors
// (share/lab/2026-11-21_end_of_adjustment.md).
constexpr double kEnoughDecrease = 1e-3;

}  // namespace

Window::Adjustment Window::build_adjustment() {
  Adjustment a;
  BaProblem& problem = a.problem;
  problem.pinhole = pinhole_;
  for (const Keyframe& k : keyframes_) {
    problem.poses.push_back({k.T_cam_world, false});
    problem.pose_ids.push_back(k.id);
  }
  const auto pose_index = [&](int id) {
    const auto it = std::lower_bound(problem.pose_ids.begin(), problem.pose_ids.end(), id);
    return int(it - problem.pose_ids.begin());
  };
  size_t matches = 0;
  for (const Keyframe& k : keyframes_)
    for (const MapPoint& p : k.points) matches += p.observations.size();
  problem.observations.reserve(matches), a.match_index.reserve(matches);
  problem.points.reserve(active_points()), a.points.reserve(active_points());
  for (size_t h = 0; h < keyframes_.size(); ++h)
    for (MapPoint& p : keyframes_[h].points) {
      if (p.observations.empty()) continue;
      for (const Observation& o : p.observations) {
        a.match_index.push_back(int(problem.observations.size()));
        problem.observations.push_back({int(problem.points.size()), pose_index(o.keyframe_id), o.match.px,
                                        o.match.normal, o.match.inv_sigma_normal, o.match.inv_sigma_tangent});
      }
      problem.points.push_back({int(h), pinhole_.ray(p.px), p.idepth, is_depth_held(p)});
      a.points.push_back(&p);
    }
  add_corners(&problem);
  apply_gauge(&problem);
  return a;
}

void Window::add_corners(BaProblem* problem) const {
  for (size_t to = 0; to < keyframes_.size(); ++to) {
    const auto from =
        std::find(problem->pose_ids.begin(), problem->pose_ids.end(), keyframes_[to].corners_from);
    // It has left the window, and taken what they say into the prior.
    if (from == problem->pose_ids.end()) continue;
    for (const CornerPair& c : keyframes_[to].corners)
      problem->corners.push_back(
          {int(from - problem->pose_ids.begin()), int(to), c.from, c.to, 1 / kCornerSigmaPx});
  }
}

void Window::apply_gauge(BaProblem* problem) const {
  if (problem->poses.empty()) return;
  problem->prior = prior_;
  const bool marginalised = prior_ && !bootstrap_gauge_;
  if (marginalised) return;  // the prior holds position, rotation and scale
  problem->poses[0].fixed = true;
  if (!bootstrap_gauge_ && problem->poses.size() > 2) problem->poses[1].fixed = true;
}

void Window::take_result(const BaResult& result, const Adjustment& a) {
  for (size_t i = 0; i < keyframes_.size(); ++i) keyframes_[i].T_cam_world = a.problem.poses[i].T_cam_world;
  for (size_t i = 0; i < a.points.size(); ++i) {
    a.points[i]->idepth = a.problem.points[i].idepth;
    if (result.idepth_sigma[i] > 0) a.points[i]->idepth_sigma = result.idepth_sigma[i];
  }
}

void Window::update_matches(const BaResult& result, const Adjustment& adjustment) {
  size_t k = 0;  // matches stand in the order of build_adjustment
  const std::vector<MapPoint*>& points = adjustment.points;
  size_t next = 0;
  for (Keyframe& host : keyframes_) {
    const std::vector<View> views = views_from(host);
    for (MapPoint& p : host.points) {
      if (next >= points.size() || points[next] != &p) continue;
      ++next;
      size_t kept = 0;
      for (Observation& o : p.observations) {
        const int index = adjustment.match_index[k++];
        const double normal_px = result.residual_normal_px[index],
                     tangent_px = result.residual_tangent_px[index];
        if (needs_update(o.match, normal_px, tangent_px, association_)) {
          const auto view = std::find_if(views.begin(), views.end(),
                                         [&](const View& v) { return v.target->id == o.keyframe_id; });
          o.match = associate(query(host, p, *view), association_);
        }
        if (o.match.kind != MatchKind::kNone) p.observations[kept++] = o;
      }
      p.observations.resize(kept);
    }
  }
}

void Window::drop_unfit(const BaResult& result, const Adjustment& adjustment) {
  size_t k = 0;
  for (MapPoint* p : adjustment.points) {
    size_t kept = 0;
    for (const Observation& o : p->observations) {
      const double residual_px = result.residual_normal_px[adjustment.match_index[k++]];
      const double sigmas = std::abs(residual_px) * o.match.inv_sigma_normal;
      if (sigmas < kDropSigmas || !rule("unfit matches"))
        p->observations[kept++] = o;
      else
        ++p->misses;
    }
    p->observations.resize(kept);
  }
  for (Keyframe& host : keyframes_) {
    auto gone = std::remove_if(host.points.begin(), host.points.end(), [](const MapPoint& p) {
      return p.observations.empty() || (p.misses > kMaxMisses && rule("missed points")) || !(p.idepth > 0);
    });
    host.points.erase(gone, host.points.end());
  }
}

WindowStats Window::adjust() {
  WindowStats stats;
  BaOptions options;
  options.huber_width = params_.ba_huber;
  options.max_iterations = params_.ba_iterations;
  options.relative_decrease = kEnoughDecrease;
  Adjustment adjustment = build_adjustment();
  BaResult result = adjuster_->solve(&adjustment.problem, options);
  if (!result.usable) return stats;
  take_result(result, adjustment);
  if (params_.ba_update_iterations > 0) {
    update_matches(result, adjustment);
    options.max_iterations = params_.ba_update_iterations;
    adjustment = build_adjustment();
    result = adjuster_->solve(&adjustment.problem, options);
    if (!result.usable) return stats;
    take_result(result, adjustment);
  }
  const BaProblem& problem = adjustment.problem;
  stats.observations = int(problem.observations.size());
  stats.points = int(problem.points.size());
  stats.cost_per_observation = result.final_cost / std::max(1, stats.observations);
  for (const BaObservation& o : problem.observations) {
    stats.photometric += o.inv_sigma_tangent > 0;
    stats.matched_in_newest += o.target + 1 == int(keyframes_.size());
  }
  drop_unfit(result, adjustment);
  return stats;
}

}  // namespace edgevo
