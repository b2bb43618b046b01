// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/window.h"

#include <algorithm>
#include <map>
#include <utility>

#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/bundle_adjustment/problem_index.h"
#include "in_view.h"

namespace edgevo {
namespace {

// Covariance of a window pose against another one after an adjustment, squared map units and radians: a
// standard deviation of 1e-4, small compared with that of tracking.
Matrix6d adjusted_covariance() { return 1e-8 * Matrix6d::Identity(); }

// Keyframes of the window that a leaving one is related to: those that constrain it best.
constexpr size_t kMaxNeighbours = 4;

}  // namespace

Window::Window(Map* map, const Rectification& rectification, const WindowParams& params,
               const AssociationParams& association)
    : map_(map),
      pinhole_(rectification.target()),
      cells_(rectification, kActivationCellPx),
      params_(params),
      association_(association),
      adjuster_(make_bundle_adjuster(params.solver)) {}

int Window::active_points() const {
  int n = 0;
  for (const Keyframe& k : keyframes()) n += int(k.points.size());
  return n;
}

std::vector<Window::View> Window::views_from(const Keyframe& host) const {
  std::vector<View> views;
  for (const Keyframe& target : keyframes())
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
  position_variance_ = pose_covariance.topLeftCorner<3, 3>().trace() / 3;
  new_points_ = 0, shared_variances_ = 0;
  for (Keyframe& host : keyframes()) {
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
  return older_points_ = matches;
}

double Window::carried_unit_variance() const {
  const int in_view = older_points_ + new_points_;
  return in_view > 0 ? shared_variances_ / in_view : 0;
}

void Window::fix_bootstrap_scale() {
  if (keyframes().size() < 2) return;
  prior_ = ba::fix_baseline(keyframes().front().T_cam_world, newest().T_cam_world, newest().id);
  bootstrap_gauge_ = true;
}

const Keyframe& Window::remove_oldest() {
  std::vector<NeighbourPose> neighbours = neighbours_of_oldest();
  prior_ = marginalise_oldest(&neighbours);
  bootstrap_gauge_ = false;
  const std::vector<MapPoint> passed_on = points_to_pass_on();
  const Keyframe& oldest = map_->marginalise_oldest(std::move(neighbours));
  for (Keyframe& host : keyframes()) drop_matches_in(oldest.id, &host);
  newest().points.insert(newest().points.end(), passed_on.begin(), passed_on.end());
  return oldest;
}

const Keyframe& Window::release_oldest() { return map_->marginalise_oldest(neighbours_of_oldest()); }

void Window::set_prior(const BaPrior& prior) {
  if (prior.pose_ids.empty()) return;
  prior_ = prior;
  bootstrap_gauge_ = false;
}

// The keyframes that share most matches with the oldest one.
std::vector<NeighbourPose> Window::neighbours_of_oldest() const {
  const Keyframe& oldest = keyframes().front();
  std::map<int, int> matches;  // by keyframe
  for (const MapPoint& p : oldest.points)
    for (const Observation& o : p.observations) ++matches[o.keyframe_id];
  for (const Keyframe& k : keyframes())
    for (const MapPoint& p : k.points) matches[k.id] += p.find(oldest.id) != nullptr;
  std::vector<std::pair<int, int>> ranked;  // negative number of matches, id
  for (const Keyframe& k : keyframes())
    if (k.id != oldest.id && matches[k.id] > 0) ranked.emplace_back(-matches[k.id], k.id);
  std::sort(ranked.begin(), ranked.end());
  if (ranked.size() > kMaxNeighbours) ranked.resize(kMaxNeighbours);
  std::vector<NeighbourPose> neighbours;
  for (const Keyframe& k : keyframes())
    if (std::any_of(ranked.begin(), ranked.end(), [&](const auto& r) { return r.second == k.id; }))
      neighbours.push_back({k.id, relative_pose(oldest, k), Matrix6d::Zero()});
  return neighbours;
}

// Only the points hosted by the oldest keyframe go into the prior. Points of other hosts lose their
// observation there and live on: their other observations stay in the window and must not be counted twice.
BaPrior Window::marginalise_oldest(std::vector<NeighbourPose>* neighbours) {
  const BaProblem all = build_adjustment().problem;
  BaProblem leaving = ba::problem_of_host(all, ba::index_problem(all), 0, int(all.poses.size()));
  leaving.prior = prior_;
  BaOptions options;
  options.huber_width = params_.ba_huber;
  std::vector<bool> drop;
  std::vector<RelativeCovariance> relative;
  for (const NeighbourPose& n : *neighbours) relative.push_back({n.id, n.covariance});
  BaPrior prior = marginalize(leaving, keyframes().front().id, options, &drop, &relative);
  for (size_t i = 0; i < neighbours->size(); ++i) (*neighbours)[i].covariance = relative[i].covariance;
  return prior;
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
