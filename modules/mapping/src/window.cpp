#include "edgevo/mapping/window.h"

#include <algorithm>
#include <set>

#include "edgevo/association/look_ahead.h"
#include "edgevo/association/uncertainty.h"
#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/bundle_adjustment/problem_index.h"
#include "edgevo/core/rule.h"
#include "edgevo/mapping/depth_filter.h"
#include "in_view.h"

namespace edgevo {
namespace {

// Covariance of a window pose against another one after an adjustment, squared map units and radians: a
// deviation of 1e-4, small beside the tracking covariance.
Matrix6d settled_covariance() { return 1e-8 * Matrix6d::Identity(); }

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
  q.pose_covariance = settled_covariance();
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

std::vector<Window::Sight> Window::in_sight(const ImmaturePoint& candidate,
                                            const std::vector<View>& views) const {
  std::vector<Sight> sights;
  Eigen::Vector2d px;
  for (const View& view : views)
    if (in_view(pinhole_, view.T_target_host, candidate.px, candidate.idepth, &px))
      sights.push_back({&view, px});
  return sights;
}

bool Window::try_activate(const ImmaturePoint& candidate, const std::vector<Sight>& sights, int min_matches,
                          Keyframe* host) const {
  MapPoint point;
  point.px = candidate.px;
  point.normal = candidate.normal;
  point.idepth = candidate.idepth;
  point.idepth_sigma = candidate.idepth_sigma;
  point.edge_pixel = candidate.edge_pixel;
  LookAhead look_ahead(association_);
  for (const Sight& s : sights) look_ahead.add(*s.view->target->pyramid, s.px);
  look_ahead.run();
  for (const Sight& s : sights) {
    const Match match = associate(query(*host, point, *s.view), association_);
    if (match.kind != MatchKind::kNone) point.observations.push_back({s.view->target->id, match});
  }
  if (int(point.observations.size()) < min_matches) return false;
  host->points.push_back(std::move(point));
  return true;
}

int Window::activate(int min_good, int min_matches, int at_most) {
  const CellGrid grid(pinhole_.width, pinhole_.height, kActivationCellPx);
  std::vector<int> count(grid.size(), 0);
  int active = 0;
  Eigen::Vector2d px;
  for (const Keyframe& host : keyframes_) {
    const SE3 T = relative_pose(newest(), host);
    for (const MapPoint& p : host.points) {
      ++active;
      if (host.id == newest().id)
        ++count[grid.index(p.px.x(), p.px.y())];
      else if (in_view(pinhole_, T, p.px, p.idepth, &px))
        ++count[grid.index(px.x(), px.y())];
    }
  }
  int activated = 0;
  // First one point a cell, then two: the newest hosts first, they will be seen longest.
  for (int per_cell = 1; per_cell <= 2; ++per_cell)
    for (auto host = keyframes_.rbegin(); host != keyframes_.rend(); ++host) {
      const SE3 T = relative_pose(newest(), *host);
      const std::vector<View> views = views_from(*host);
      for (ImmaturePoint& p : host->immature) {
        if (active >= params_.max_points || activated >= at_most) return activated;
        if (p.dead || p.lent || p.good < min_good) continue;
        if (!in_view(pinhole_, T, p.px, p.idepth, &px)) continue;
        int& here = count[grid.index(px.x(), px.y())];
        if (here >= per_cell) continue;
        const SE3& T_view =
            host->id == newest().id ? relative_pose(keyframes_[keyframes_.size() - 2], *host) : T;
        const DepthMotion motion =
            depth_motion(pinhole_, T_view, pinhole_.ray(p.px), p.idepth, p.idepth_sigma);
        if (motion.sigma_mu_px > params_.max_projected_sigma_px) continue;
        const std::vector<Sight> sights = in_sight(p, views);
        // New in view, as the border is when the camera backs away: it waits.
        if (int(sights.size()) < min_matches && rule("wait for views")) continue;
        const bool as_loan = p.good < 2;  // nothing has checked it
        p.dead = !as_loan;                // tried once: it becomes active or is gone
        if (!try_activate(p, sights, min_matches, &*host)) continue;
        p.lent = host->points.back().lent = as_loan;
        ++here, ++active, ++activated;
      }
    }
  return activated;
}

// A lent point that is not there any more did not fit: its immature point goes, too.
void Window::take_back() {
  for (Keyframe& host : keyframes_) {
    std::set<int> unconfirmed;
    for (MapPoint& p : host.points) {
      p.lent &= p.observations.size() < 2;
      if (p.lent) unconfirmed.insert(p.edge_pixel);
    }
    host.points.erase(
        std::remove_if(host.points.begin(), host.points.end(), [](const MapPoint& p) { return p.lent; }),
        host.points.end());
    for (ImmaturePoint& p : host.immature) {
      if (!p.lent) continue;
      p.dead |= unconfirmed.count(p.edge_pixel) == 0;
      p.lent = false;
    }
  }
}

void Window::hold_bootstrap_scale() {
  if (keyframes_.size() < 2) return;
  if (!rule("first baseline held")) return;
  prior_ = ba::hold_baseline(keyframes_.front().T_cam_world, newest().T_cam_world, newest().id);
  bootstrap_gauge_ = true;
}

Keyframe Window::remove_oldest() {
  const int id = keyframes_.front().id;
  // Only the points it hosts go into the prior with it. Points of other hosts lose their observation here and
  // live on: their other observations stay in the window and must not be counted twice.
  const BaProblem all = build_adjustment().problem;
  BaProblem leaving = ba::problem_of_host(all, ba::index_problem(all), 0, int(all.poses.size()));
  leaving.prior = prior_;
  BaOptions options;
  options.huber_width = params_.ba_huber;
  std::vector<bool> drop;
  prior_ = marginalize(leaving, id, options, &drop);
  bootstrap_gauge_ = false;
  Keyframe oldest = std::move(keyframes_.front());
  keyframes_.pop_front();
  for (Keyframe& host : keyframes_) {
    for (MapPoint& p : host.points)
      p.observations.erase(std::remove_if(p.observations.begin(), p.observations.end(),
                                          [&](const Observation& o) { return o.keyframe_id == id; }),
                           p.observations.end());
    host.points.erase(std::remove_if(host.points.begin(), host.points.end(),
                                     [](const MapPoint& p) { return p.observations.empty(); }),
                      host.points.end());
  }
  return oldest;
}

}  // namespace edgevo
