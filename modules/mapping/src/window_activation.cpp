// SPDX-License-Identifier: BSD-3-Clause
// Which immature points become active, and which of these stay.
#include <algorithm>
#include <set>

#include "edgevo/association/prefetcher.h"
#include "edgevo/association/uncertainty.h"
#include "edgevo/mapping/depth_filter.h"
#include "edgevo/mapping/window.h"
#include "in_view.h"

namespace edgevo {
namespace {

// Depth observations of a point that confirm each other, since they are of two images. A point with fewer is
// tentative.
constexpr int kConfirmingDepths = 2;
// Matches that confirm a tentative point.
constexpr size_t kConfirmingMatches = 2;
// Most active points in a cell of the newest image: one everywhere first, then a second one.
constexpr int kPointsPerCell = 2;

}  // namespace

std::vector<Window::Sight> Window::in_sight(const ImmaturePoint& candidate,
                                            const std::vector<View>& views) const {
  std::vector<Sight> sights;
  Eigen::Vector2d px;
  for (const View& view : views)
    if (in_view(pinhole_, view.T_target_host, candidate.px, candidate.idepth, &px))
      sights.push_back({&view, px});
  return sights;
}

// Number of active points by cell of the newest image. Those of an earlier host (passed on) fill no cell:
// they are the far ones, and nearer ones must come in.
std::vector<int> Window::count_active() const {
  std::vector<int> count(cells_.size(), 0);
  Eigen::Vector2d px;
  for (const Keyframe& host : keyframes()) {
    const SE3 T_newest_host = relative_pose(newest(), host);
    for (const MapPoint& p : host.points) {
      if (p.known_sigma > 0) continue;
      if (host.id == newest().id)
        ++count[cells_.index(p.px.x(), p.px.y())];
      else if (in_view(pinhole_, T_newest_host, p.px, p.idepth, &px))
        ++count[cells_.index(px.x(), px.y())];
    }
  }
  return count;
}

// Adds the immature points of a keyframe that have enough depths and lie in the newest image.
void Window::add_candidates(const ActivationPolicy& policy, CandidateHost* host,
                            std::vector<Candidate>* candidates) const {
  const SE3 T_newest_host = relative_pose(newest(), *host->keyframe);
  Eigen::Vector2d px;
  for (ImmaturePoint& p : host->keyframe->immature) {
    const bool open = !p.dead && !p.tentative && p.good >= policy.min_depths;
    if (open && in_view(pinhole_, T_newest_host, p.px, p.idepth, &px))
      candidates->push_back({host, &p, cells_.index(px.x(), px.y())});
  }
}

// Evaluates the depth uncertainty projected into the newest of the other keyframes.
bool Window::is_certain(const Candidate& c) const {
  const ImmaturePoint& p = *c.point;
  const DepthMotion motion = depth_motion(pinhole_, c.host->views.back().T_target_host, pinhole_.ray(p.px),
                                          p.idepth, p.idepth_sigma);
  return !(motion.sigma_mu_px > params_.max_projected_sigma_px);
}

// Matches the point in all keyframes that have it in view.
MapPoint Window::match_candidate(const Candidate& c, const std::vector<Sight>& sights) const {
  MapPoint point;
  point.px = c.point->px;
  point.normal = c.point->normal;
  point.idepth = c.point->idepth;
  point.idepth_sigma = c.point->idepth_sigma;
  point.edge_pixel = c.point->edge_pixel;
  Prefetcher prefetcher(association_);
  for (const Sight& s : sights) prefetcher.add(*s.view->target->pyramid, s.px);
  prefetcher.run();
  for (const Sight& s : sights) {
    const Match match = associate(query(*c.host->keyframe, point, *s.view), association_);
    if (match.kind != MatchKind::kNone) point.observations.push_back({s.view->target->id, match});
  }
  return point;
}

// Of the logarithm of a new point's depth: what all points matched in the same views share. No more than 1: a
// factor of e either way is nothing known.
void Window::add_shared_variance(const MapPoint& point, const std::vector<Sight>& sights) {
  double baseline = 0;
  for (const Sight& s : sights)
    if (point.find(s.view->target->id))
      baseline = std::max(baseline, s.view->T_target_host.translation().norm());
  ++new_points_;
  shared_variances_ += std::min(1.0, position_variance_ / (baseline * baseline));
}

bool Window::try_activate(const ActivationPolicy& policy, const Candidate& c) {
  if (!is_certain(c)) return false;
  const std::vector<Sight> sights = in_sight(*c.point, c.host->views);
  // Points new in view, as at the border when the camera backs away, wait.
  if (int(sights.size()) < policy.min_matches) return false;
  const bool tentative = c.point->good < kConfirmingDepths;
  // A point is tried once: it becomes active or is removed.
  c.point->dead = !tentative;
  MapPoint point = match_candidate(c, sights);
  if (int(point.observations.size()) < policy.min_matches) return false;
  point.tentative = c.point->tentative = tentative;
  add_shared_variance(point, sights);
  c.host->keyframe->points.push_back(std::move(point));
  return true;
}

int Window::activate(const ActivationPolicy& policy) {
  const int budget = std::min(policy.budget, params_.max_points - active_points());
  if (budget <= 0 || keyframes().size() < 2) return 0;
  // The newest hosts first: their points will be seen longest.
  std::vector<CandidateHost> hosts;
  for (auto k = keyframes().rbegin(); k != keyframes().rend(); ++k) hosts.push_back({&*k, views_from(*k)});
  std::vector<Candidate> candidates;
  for (CandidateHost& host : hosts) add_candidates(policy, &host, &candidates);

  std::vector<int> points_in_cell = count_active();
  int activated = 0;
  for (int per_cell = 1; per_cell <= kPointsPerCell; ++per_cell)
    for (Candidate& c : candidates) {
      if (c.tried || points_in_cell[c.cell] >= per_cell) continue;
      c.tried = true;
      if (!try_activate(policy, c)) continue;
      ++points_in_cell[c.cell];
      if (++activated == budget) return activated;
    }
  return activated;
}

// A tentative point that no longer exists did not fit: its immature point is removed, too.
void Window::demote_unconfirmed() {
  for (Keyframe& host : keyframes()) {
    std::set<int> unconfirmed;
    for (MapPoint& p : host.points) {
      p.tentative &= p.observations.size() < kConfirmingMatches;
      if (p.tentative) unconfirmed.insert(p.edge_pixel);
    }
    host.points.erase(
        std::remove_if(host.points.begin(), host.points.end(), [](const MapPoint& p) { return p.tentative; }),
        host.points.end());
    for (ImmaturePoint& p : host.immature) {
      if (!p.tentative) continue;
      p.dead |= unconfirmed.count(p.edge_pixel) == 0;
      p.tentative = false;
    }
  }
}

}  // namespace edgevo
