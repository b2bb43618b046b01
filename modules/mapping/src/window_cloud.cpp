// SPDX-License-Identifier: BSD-3-Clause
// The clouds that the tracker receives: the points of known depth that a keyframe sees, and immature ones if
// those are few.
#include <algorithm>

#include "edgevo/alignment/projection.h"
#include "edgevo/mapping/depth_filter.h"
#include "edgevo/mapping/window.h"

namespace edgevo {
namespace {

// Points of known depth below which the cloud is filled up with immature ones, and below which tentative ones
// are added to the map: with 300 and 400 runs were lost, 700 costs accuracy
// (lab 2026-11-22_sparse_maps).
constexpr size_t kEnoughCloud = 500;
// Points of known depth per cell of the activation below which a small image also has few: 402 at 640x480.
constexpr double kSparseShare = 0.25;

// Selects `wanted` points in even steps.
std::vector<CloudPoint> every_nth(const std::vector<CloudPoint>& points, size_t wanted) {
  std::vector<CloudPoint> thinned;
  thinned.reserve(wanted);
  for (size_t i = 0; i < wanted; ++i) thinned.push_back(points[i * points.size() / wanted]);
  return thinned;
}

}  // namespace

int Window::points_wanted() const {
  return int(std::min(kEnoughCloud, size_t(kSparseShare * cells_.size())));
}

int Window::points_lacking() const { return std::max(0, points_wanted() - int(cloud(newest()).size())); }

// Adds immature points of a keyframe, selected in even steps. Their depth is a guess that the tracker weights
// by its sigma: under a pure rotation, where depth does not matter, they count fully
// (lab 2026-11-22_rotation_on_the_spot).
void Window::add_immature(const Keyframe& host, size_t wanted, std::vector<CloudPoint>* cloud) const {
  std::vector<const ImmaturePoint*> alive;
  for (const ImmaturePoint& p : host.immature)
    if (!p.dead) alive.push_back(&p);
  wanted = std::min(wanted, alive.size());
  for (size_t i = 0; i < wanted; ++i) {
    const ImmaturePoint& p = *alive[i * alive.size() / wanted];
    const bool measured = p.good > 0;
    cloud->push_back({pinhole_.ray(p.px), measured ? p.idepth : p.idepth_guess,
                      measured ? p.idepth_sigma : p.idepth_guess, p.px.cast<float>(),
                      p.normal.cast<float>()});
  }
}

std::vector<CloudPoint> Window::tracking_cloud(const Keyframe& reference) const {
  std::vector<CloudPoint> points = cloud(reference);
  const size_t enough = std::min(kEnoughCloud, size_t(params_.max_cloud_points));
  if (points.size() < enough && params_.track_immature_points)
    add_immature(reference, enough - points.size(), &points);
  return points;
}

std::vector<CloudPoint> Window::cloud(const Keyframe& reference) const {
  std::vector<CloudPoint> cloud;
  for (const Keyframe& host : keyframes()) {
    const SE3 T_reference_host = relative_pose(reference, host);
    for (const MapPoint& p : host.points) {
      std::optional<CloudPoint> c =
          host.id == reference.id ? own_point(p) : seen_point(reference, T_reference_host, p);
      if (!c) continue;
      c->host_keyframe = host.id;
      c->host_pixel = p.edge_pixel;
      cloud.push_back(*c);
    }
  }
  const size_t limit = size_t(params_.max_cloud_points);
  return cloud.size() > limit ? every_nth(cloud, limit) : cloud;
}

// Cloud point of a point that the reference hosts.
CloudPoint Window::own_point(const MapPoint& p) const {
  return {pinhole_.ray(p.px), p.idepth, p.idepth_sigma, p.px.cast<float>(), p.normal.cast<float>()};
}

// Cloud point of a point of another host in the frame of the reference; nothing if it is not seen there.
std::optional<CloudPoint> Window::seen_point(const Keyframe& reference, const SE3& T_reference_host,
                                             const MapPoint& p) const {
  const Observation* seen = p.find(reference.id);
  if (!seen) return std::nullopt;
  const Eigen::Vector3d Y =
      T_reference_host.R() * pinhole_.ray(p.px) + p.idepth * T_reference_host.translation();
  if (!(Y.z() > kMinProjectedDepth)) return std::nullopt;
  const Eigen::Vector2d px = pinhole_.project(Y);
  if (!pinhole_.contains(px)) return std::nullopt;
  // rho' = rho / Y_z, and the same for its sigma to first order.
  return CloudPoint{Y / Y.z(), p.idepth / Y.z(), p.idepth_sigma / Y.z(), px.cast<float>(),
                    seen->match.normal.cast<float>()};
}

double Window::view_share(const Keyframe& keyframe) const {
  int all = 0, in_view = 0;
  for (const Keyframe& host : keyframes()) {
    const SE3 T = relative_pose(keyframe, host);
    const Eigen::Matrix3d R = T.R();
    all += int(host.points.size());
    for (const MapPoint& p : host.points) {
      const Eigen::Vector3d Y = R * pinhole_.ray(p.px) + p.idepth * T.translation();
      in_view += Y.z() > kMinProjectedDepth && pinhole_.contains(pinhole_.project(Y));
    }
  }
  return all > 0 ? double(in_view) / all : 0.0;
}

}  // namespace edgevo
