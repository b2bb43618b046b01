// SPDX-License-Identifier: BSD-3-Clause
// The window's bundle adjustment: builds the problem from the keyframes and their matches, and applies its
// solution to them.
#include <algorithm>
#include <cmath>

#include "edgevo/mapping/window.h"

namespace edgevo {
namespace {

// Keyframes that may miss a point before it is dropped: a quarter of the window, an occlusion or two.
constexpr int kMaxMisses = 3;
// Standard deviations beyond which a match is dropped after the last adjustment: rarely by chance.
constexpr double kDropSigmas = 4.0;
constexpr double kCornerSigmaPx = 0.5;  // standard deviation of a corner
// Relative decrease of the cost that ends an adjustment: what is left is below the noise of the matches. A
// fifth less time than with 1e-4, at the same errors (lab 2026-11-21_end_of_adjustment).
constexpr double kEnoughDecrease = 1e-3;

}  // namespace

Window::Adjustment Window::build_adjustment() {
  Adjustment a;
  a.problem.pinhole = pinhole_;
  size_t matches = 0;
  for (const Keyframe& k : keyframes()) {
    a.problem.poses.push_back({k.T_cam_world, false});
    a.problem.pose_ids.push_back(k.id);
    for (const MapPoint& p : k.points) matches += p.observations.size();
  }
  a.problem.observations.reserve(matches);
  a.match_index.reserve(matches);
  a.problem.points.reserve(active_points());
  a.points.reserve(active_points());
  for (size_t host = 0; host < keyframes().size(); ++host)
    for (MapPoint& p : keyframes()[host].points)
      if (!p.observations.empty()) add_point(int(host), &p, &a);
  add_corners(&a.problem);
  add_turns(&a.problem);
  apply_gauge(&a.problem);
  return a;
}

void Window::add_point(int host, MapPoint* point, Adjustment* a) const {
  BaProblem& problem = a->problem;
  const std::vector<int>& ids = problem.pose_ids;
  const int index = int(problem.points.size());
  for (const Observation& o : point->observations) {
    const int target = int(std::lower_bound(ids.begin(), ids.end(), o.keyframe_id) - ids.begin());
    a->match_index.push_back(int(problem.observations.size()));
    problem.observations.push_back(
        {index, target, o.match.px, o.match.normal, o.match.inv_sigma_normal, o.match.inv_sigma_tangent});
  }
  BaPoint p{host, pinhole_.ray(point->px), point->idepth, is_depth_fixed(*point)};
  if (point->known_sigma > 0) {
    p.known_idepth = point->known_idepth;
    p.known_information = 1 / (point->known_sigma * point->known_sigma);
  }
  problem.points.push_back(p);
  a->points.push_back(point);
}

void Window::add_corners(BaProblem* problem) const {
  if (!params_.adjust_corners) return;
  for (size_t to = 0; to < keyframes().size(); ++to) {
    const auto from =
        std::find(problem->pose_ids.begin(), problem->pose_ids.end(), keyframes()[to].corners_from);
    // That keyframe has left the window, and the information of its corners is in the prior.
    if (from == problem->pose_ids.end()) continue;
    for (const CornerPair& c : keyframes()[to].corners)
      problem->corners.push_back(
          {int(from - problem->pose_ids.begin()), int(to), c.from, c.to, 1 / kCornerSigmaPx});
  }
}

void Window::add_turns(BaProblem* problem) const {
  const std::vector<int>& ids = problem->pose_ids;
  for (size_t to = 0; to < keyframes().size(); ++to) {
    const std::optional<KeyframeTurn>& turn = keyframes()[to].turn;
    if (!turn) continue;
    const auto from = std::find(ids.begin(), ids.end(), turn->from);
    if (from != ids.end())  // else its information is in the prior
      problem->turns.push_back({int(from - ids.begin()), int(to), turn->R, turn->information});
  }
}

void Window::apply_gauge(BaProblem* problem) const {
  if (problem->poses.empty()) return;
  problem->prior = prior_;
  const bool marginalised = prior_ && !bootstrap_gauge_;
  if (marginalised) return;  // the prior fixes position, rotation and scale
  problem->poses[0].fixed = true;
  if (!bootstrap_gauge_ && problem->poses.size() > 2) problem->poses[1].fixed = true;
}

void Window::take_result(const BaResult& result, const Adjustment& a) {
  for (size_t i = 0; i < keyframes().size(); ++i) keyframes()[i].T_cam_world = a.problem.poses[i].T_cam_world;
  for (size_t i = 0; i < a.points.size(); ++i) {
    a.points[i]->idepth = a.problem.points[i].idepth;
    if (result.idepth_sigma[i] > 0) a.points[i]->idepth_sigma = result.idepth_sigma[i];
  }
}

void Window::update_matches(const BaResult& result, const Adjustment& adjustment) {
  std::vector<std::vector<View>> views;
  for (const Keyframe& host : keyframes()) views.push_back(views_from(host));
  size_t k = 0;  // matches are in the order of build_adjustment
  for (size_t i = 0; i < adjustment.points.size(); ++i) {
    MapPoint& p = *adjustment.points[i];
    const size_t host = size_t(adjustment.problem.points[i].host);
    size_t kept = 0;
    for (Observation& o : p.observations) {
      const int index = adjustment.match_index[k++];
      if (needs_update(o.match, result.residual_normal_px[index], result.residual_tangent_px[index],
                       association_))
        o.match = match_again(keyframes()[host], p, o.keyframe_id, views[host]);
      if (o.match.kind != MatchKind::kNone) p.observations[kept++] = o;
    }
    p.observations.resize(kept);
  }
}

// `keyframe_id` must be that of one of the views.
Match Window::match_again(const Keyframe& host, const MapPoint& point, int keyframe_id,
                          const std::vector<View>& views) const {
  const auto view =
      std::find_if(views.begin(), views.end(), [&](const View& v) { return v.target->id == keyframe_id; });
  return associate(query(host, point, *view), association_);
}

void Window::drop_unfit(const BaResult& result, const Adjustment& adjustment) {
  size_t k = 0;
  for (MapPoint* p : adjustment.points) {
    size_t kept = 0;
    for (const Observation& o : p->observations) {
      const double residual_px = result.residual_normal_px[adjustment.match_index[k++]];
      const double sigmas = std::abs(residual_px) * o.match.inv_sigma_normal;
      if (sigmas < kDropSigmas || !params_.drop_outlier_matches)
        p->observations[kept++] = o;
      else
        ++p->misses;
    }
    p->observations.resize(kept);
  }
  for (Keyframe& host : keyframes()) {
    auto gone = std::remove_if(host.points.begin(), host.points.end(), [&](const MapPoint& p) {
      const bool is_missed = params_.drop_missed_points && p.misses > kMaxMisses;
      return p.observations.empty() || is_missed || !(p.idepth > 0);
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
  stats.unit_variance = carried_unit_variance();
  stats.observations = int(problem.observations.size());
  stats.points = int(problem.points.size());
  stats.cost_per_observation = result.final_cost / std::max(1, stats.observations);
  for (const BaObservation& o : problem.observations) {
    stats.photometric += o.inv_sigma_tangent > 0;
    stats.matched_in_newest += o.target + 1 == int(keyframes().size());
  }
  drop_unfit(result, adjustment);
  return stats;
}

}  // namespace edgevo
