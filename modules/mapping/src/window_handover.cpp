// SPDX-License-Identifier: BSD-3-Clause
// Points that outlive their host. Where the camera turns, the view leaves a window before the camera has
// moved far, and its matches alone do not hold the unit of length: depths that are known carry it to the next
// keyframes (lab 2026-11-27_points_passed_on).
#include <algorithm>
#include <cmath>

#include "edgevo/core/order_statistics.h"
#include "edgevo/mapping/window.h"

namespace edgevo {
namespace {

// Length of a window over the median depth from which on its own matches hold the unit: half the depth is a
// parallax of 27 degrees. Depths passed on over a longer way are those of far points, and cost drives
// accuracy.
constexpr double kLongWindow = 0.5;
// Matches that make a depth known: with two it is fitted, the third one confirms it.
constexpr size_t kConfirmedMatches = 3;
// Largest share of an inverse depth that its standard deviation may be: what is known less says nothing of
// the unit.
constexpr double kMaxSigmaShare = 0.3;
// Largest distance from the edge that the point was matched with, pixels: adjusted, it lies on it.
constexpr double kMaxOffEdgePx = 1;
// Least depth in the newest keyframe over that in the host: nearer points are about to leave the view.
constexpr double kMinDepthRatio = 0.1;
// Standard deviations of a depth passed on, over that of the adjustment: that one takes the poses as known,
// and the prior of the window has the same matches, too.
constexpr double kSigmaFactor = 2;
// Points nearer to each other are of one edge pixel, pixels.
constexpr double kSamePointPx = 2;

bool is_long(const SE3& T_newest_oldest, const std::vector<CloudPoint>& seen) {
  std::vector<double> idepths;
  for (const CloudPoint& p : seen) idepths.push_back(p.idepth);
  return T_newest_oldest.translation().norm() * median(std::move(idepths)) > kLongWindow;
}

bool is_taken(const std::vector<MapPoint>& points, const MapPoint& point) {
  return std::any_of(points.begin(), points.end(), [&](const MapPoint& p) {
    return p.edge_pixel == point.edge_pixel || (p.px - point.px).norm() < kSamePointPx;
  });
}

bool is_depth_known(const MapPoint& p) {
  return !p.tentative && !is_depth_fixed(p) && p.observations.size() >= kConfirmedMatches && p.idepth > 0 &&
         p.idepth_sigma > 0 && p.idepth_sigma <= kMaxSigmaShare * p.idepth;
}

}  // namespace

// A point of another host as a point of the newest keyframe, on the edge that it matches there; nothing if it
// lies off that edge. rho' = rho / Y_z, and the same for its sigma to first order.
std::optional<MapPoint> Window::in_newest(const MapPoint& point, const SE3& T_newest_host) const {
  const Observation* seen = point.find(newest().id);
  const Eigen::Vector3d Y =
      T_newest_host.R() * pinhole_.ray(point.px) + point.idepth * T_newest_host.translation();
  if (!seen || !(Y.z() > kMinDepthRatio)) return std::nullopt;
  const Match& match = seen->match;
  if (std::abs(match.normal.dot(pinhole_.project(Y) - match.px)) > kMaxOffEdgePx) return std::nullopt;
  MapPoint p;
  p.px = match.px;
  p.normal = match.normal;
  p.idepth = p.known_idepth = point.idepth / Y.z();
  p.idepth_sigma = point.idepth_sigma / Y.z();
  p.known_sigma = kSigmaFactor * p.idepth_sigma;
  p.edge_pixel = newest().pyramid->finest().field.nearest(float(p.px.x()), float(p.px.y()));
  return p;
}

std::vector<MapPoint> Window::points_to_pass_on() const {
  std::vector<MapPoint> passed_on;
  const Keyframe& oldest = keyframes().front();
  const SE3 T_newest_oldest = relative_pose(newest(), oldest);
  if (!params_.pass_on_points || is_long(T_newest_oldest, cloud(newest()))) return passed_on;
  for (const MapPoint& point : oldest.points) {
    if (!is_depth_known(point)) continue;
    const std::optional<MapPoint> p = in_newest(point, T_newest_oldest);
    if (!p || p->edge_pixel < 0 || is_taken(newest().points, *p) || is_taken(passed_on, *p)) continue;
    passed_on.push_back(*p);
  }
  return passed_on;
}

}  // namespace edgevo
