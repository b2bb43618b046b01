// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/window.h"

#include <algorithm>

#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/bundle_adjustment/problem_index.h"
#include "in_view.h"

namespace edgevo {
namespace {

// Covariance of a window pose against another one after an adjustment, squared map units and radians: a
// standard deviation of 1e-4, small compared with that of tracking.
Matrix6d adjusted_covariance() { return 1e-8 * Matrix6d::Identity(); }

}  // namespace

Window::Window(const Pinhole& pinhole, const WindowParams& params, const AssociationParams& association)
    : pinhole_(pinhole),
      params_(params),
      association_(association),
      adjuster_(make_bundle_adjuster(params.solver)) {}

int Window::active_points() const {
  int n = 0;
  for (const Keyframe& k : keyframes_) n += int(k.points.size());
  return n;
}

std::vector<Window::View> Window::views_from(const Keyframe& host) const {
  std::vector<View> views;
  for (const Keyframe& target : keyframes_)
    if (target.id != host.id) views.push_back({&target, relative_pose(target, host)});
  return views;
}

AssociationQuery Window::query(const Keyframe& host, const MapPoint& point, const View& view) const {
  AssociationQuery q;
  q.host = host.pyramid.get();
  q.target = view.target->pyramid.get();
  q.px_host = point.px;
  q.normal_host = point.normal;
  q.idepth = point.idepth;
  q.idepth_sigma = point.idepth_sigma;
  q.T_target_host = view.T_target_host;
  q.pose_covariance = adjusted_covariance();
  return q;
}

int Window::associate_newest(const Matrix6d& pose_covariance) {
  int matches = 0;
  const Keyframe& target = newest();
  for (Keyframe& host : keyframes_) {
    if (host.id == target.id) continue;
    const View view{&target, relative_pose(target, host)};
    for (MapPoint& point : host.points) {
      Eigen::Vector2d px;
      if (!in_view(pinhole_, view.T_target_host, point.px, point.idepth, &px)) continue;
      AssociationQuery q = query(host, point, view);
      q.pose_covariance = pose_covariance;
      const Match match = associate(q, association_);
      if (match.kind == MatchKind::kNone) {
        ++point.misses;
        continue;
      }
      point.observations.push_back({target.id, match});
      ++matches;
    }
  }
  return matches;
}

void Window::fix_bootstrap_scale() {
  if (keyframes_.size() < 2) return;
  prior_ = ba::fix_baseline(keyframes_.front().T_cam_world, newest().T_cam_world, newest().id);
  bootstrap_gauge_ = true;
}

Keyframe Window::remove_oldest() {
  prior_ = marginalise_oldest();
  bootstrap_gauge_ = false;
  Keyframe oldest = std::move(keyframes_.front());
  keyframes_.pop_front();
  for (Keyframe& host : keyframes_) drop_matches_in(oldest.id, &host);
  return oldest;
}

// Only the points hosted by the oldest keyframe go into the prior. Points of other hosts lose their
// observation there and live on: their other observations stay in the window and must not be counted twice.
BaPrior Window::marginalise_oldest() {
  const BaProblem all = build_adjustment().problem;
  BaProblem leaving = ba::problem_of_host(all, ba::index_problem(all), 0, int(all.poses.size()));
  leaving.prior = prior_;
  BaOptions options;
  options.huber_width = params_.ba_huber;
  std::vector<bool> drop;
  return marginalize(leaving, keyframes_.front().id, options, &drop);
}

// Removes matches in a keyframe, and points that were matched nowhere else.
void Window::drop_matches_in(int keyframe_id, Keyframe* host) {
  for (MapPoint& p : host->points)
    p.observations.erase(std::remove_if(p.observations.begin(), p.observations.end(),
                                        [&](const Observation& o) { return o.keyframe_id == keyframe_id; }),
                         p.observations.end());
  host->points.erase(std::remove_if(host->points.begin(), host->points.end(),
                                    [](const MapPoint& p) { return p.observations.empty(); }),
                     host->points.end());
}

}  // namespace edgevo
