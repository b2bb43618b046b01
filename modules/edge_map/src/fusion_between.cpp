// SPDX-License-Identifier: BSD-3-Clause
// Lines of frames between keyframes, of what no keyframe sees from near: a fast vehicle passes it in between.
// They become lines of the keyframe before, as it would see them. And what such frames are aligned to.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "depth_evidence.h"
#include "edge_fusion.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

// Share of the vertices of a keyframe that are farther than what it sees from near.
constexpr double kNearestShare = 0.95;

constexpr size_t kCloudPoints = 1000;  // that views are aligned to: with 100 half of the gain is lost

// The views of a keyframe, and itself, as those of its view `host`: nearest first, frames between keyframes
// in turn with keyframes (edge_mapper.cpp).
std::vector<EdgeView> views_from(const EdgeHost& keyframe, const std::vector<EdgeView>& views, size_t host) {
  const double gain = views[host].gain;
  const SE3 T_keyframe_host = views[host].T_view_host.inverse();
  std::vector<EdgeView> keyframes{{keyframe.pyramid, keyframe.sides, T_keyframe_host, 1 / gain}}, between;
  for (size_t i = 0; i < views.size(); ++i) {
    EdgeView view = views[i];
    view.T_view_host = view.T_view_host * T_keyframe_host, view.gain /= gain;
    if (i != host) (view.is_tracked ? between : keyframes).push_back(std::move(view));
  }
  const auto is_nearer = [](const EdgeView& a, const EdgeView& b) {
    return a.T_view_host.translation().norm() < b.T_view_host.translation().norm();
  };
  std::stable_sort(keyframes.begin(), keyframes.end(), is_nearer);
  std::stable_sort(between.begin(), between.end(), is_nearer);
  for (size_t i = 0; i < between.size(); ++i)
    keyframes.insert(keyframes.begin() + long(std::min(2 * i, keyframes.size())), std::move(between[i]));
  return keyframes;
}

// The vertex as another camera sees it; false if it does not.
bool move_to_camera(const Pinhole& pinhole, const SE3& T_to_from, EdgeVertex* v) {
  const Eigen::Vector3d p = T_to_from * (pinhole.ray(v->px.cast<double>()) / double(v->idepth));
  if (!(p.z() > 0)) return false;
  const float ratio = float(1 / (p.z() * double(v->idepth)));  // of the inverse depths
  v->px = pinhole.project(p).cast<float>();
  v->idepth *= ratio, v->idepth_sigma *= ratio * ratio;
  return pinhole.contains(v->px.cast<double>(), kEdgeBorderPx);
}

// The frames after a keyframe, ahead of it: how far, and which view.
std::vector<std::pair<double, size_t>> views_ahead(const std::vector<EdgeView>& views) {
  std::vector<std::pair<double, size_t>> ahead;
  for (size_t i = 0; i < views.size(); ++i) {
    const double forward = views[i].T_view_host.inverse().translation().z();
    if (views[i].is_after_host && forward > 0) ahead.emplace_back(forward, i);
  }
  std::sort(ahead.begin(), ahead.end());
  return ahead;
}

}  // namespace

// Some vertices of the lines so far that lie in the image of the host, evenly from all.
std::vector<CloudPoint> EdgeFusion::cloud_for(const EdgeHost& host) const {
  std::vector<CloudPoint> points;
  for (const OpenHost& open : open_) {
    const SE3 T_host_open = host.T_cam_world * open.T_cam_world.inverse();
    const ViewGeometry view(pinhole_, {host.pyramid, host.sides, T_host_open, 1});
    for (const Line& line : open.lines)
      for (const Vertex& v : line) add_to_cloud(view, v, &points);
  }
  const size_t step = 1 + points.size() / kCloudPoints;
  size_t kept = 0;
  for (size_t i = 0; i < points.size(); i += step) points[kept++] = points[i];
  points.resize(kept);
  return points;
}

void EdgeFusion::add_to_cloud(const ViewGeometry& view, const Vertex& v,
                              std::vector<CloudPoint>* points) const {
  if (v.is_replaced || !v.is_mostly_seen()) return;
  const SightLine ray(view, v.vertex.px.cast<double>());
  const double idepth = double(v.vertex.idepth), depth_ratio = ray.depth(idepth);
  if (!(depth_ratio > kMinDepthRatio)) return;
  CloudPoint p;
  const Eigen::Vector2d px = ray.at(idepth);
  if (!pinhole_.contains(px, kSeenBorderPx)) return;
  p.ray = pinhole_.ray(px), p.px = px.cast<float>();
  p.idepth = idepth / depth_ratio, p.idepth_sigma = double(v.vertex.idepth_sigma) / depth_ratio;
  p.normal = (view.turn * v.normal.cast<double>()).cast<float>();
  points->push_back(p);
}

void EdgeFusion::predict_planes(const SE3& T_cam_world) {
  const SE3 T_plane_cam = T_plane_host_ * T_host_world_ * T_cam_world.inverse();
  for (EdgePlane& plane : planes_) plane = plane.seen_from(pinhole_, T_plane_cam);
}

// With another lens, the planes are found anew.
void EdgeFusion::move_planes(const MapMoved& moved) {
  const KeyframeMove* m = moved.find(plane_host_);
  if (!m || moved.lens) return planes_.clear();
  for (EdgePlane& plane : planes_) plane = plane.scaled(m->scale_ratio);
  T_host_world_ = moved.T_cam_map(*m);
  T_plane_host_ = SE3(T_plane_host_.rotation(), m->scale_ratio * T_plane_host_.translation());
}

// What is as near as the nearest edges of the keyframe is seen from too far by the host before where the
// camera has moved on by this share of its depth.
void EdgeFusion::add_between(const EdgeHost& keyframe, const std::vector<EdgeView>& views) {
  constexpr double kGap = kMaxDepthRatio - 1;
  const double nearest = nearest_idepth();
  double last = 0;
  for (const auto& [forward, i] : views_ahead(views)) {
    if ((forward - last) * nearest < kGap) continue;
    const SE3& T_host_keyframe = views[i].T_view_host;
    const EdgeHost host{-1, views[i].pyramid, views[i].sides, T_host_keyframe * keyframe.T_cam_world,
                        keyframe.max_idepth};
    predict_planes(host.T_cam_world);
    T_plane_host_ = T_host_keyframe;
    for (const Line& line : find_lines(host, views_from(keyframe, views, i)))
      add_seen_between(line, T_host_keyframe.inverse(), &open_.back().lines);
    last = forward;
  }
}

// Of the new lines of the last keyframe; 0 without any.
double EdgeFusion::nearest_idepth() const {
  std::vector<double> idepths;
  for (const Line& line : open_.back().lines)
    for (const Vertex& v : line) idepths.push_back(double(v.vertex.idepth));
  return idepths.empty() ? 0 : quantile(std::move(idepths), kNearestShare);
}

// Where the keyframe would not see a vertex, or a pixel after it, the line ends.
void EdgeFusion::add_seen_between(const Line& line, const SE3& T_keyframe_host,
                                  std::vector<Line>* lines) const {
  const SE3 T = T_keyframe_host;
  const Eigen::Matrix3d R = T.R();
  const Eigen::Rotation2Df turn(float(std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1))));
  Line moved;
  const auto flush = [&] {
    if (moved.size() >= 2) lines->push_back(std::move(moved));
    moved.clear();
  };
  for (size_t i = 0; i < line.size(); ++i) {
    Vertex v = line[i];
    bool goes_on = i + 1 < line.size();
    for (size_t k = 0; k < v.after.size() && goes_on; ++k) {
      v.after[k].idepth = idepth_after(v, line[i + 1], k);
      goes_on = move_to_camera(pinhole_, T, &v.after[k]);
    }
    const bool is_seen = move_to_camera(pinhole_, T, &v.vertex);
    v.weight = weight_of(double(v.vertex.idepth), double(v.vertex.idepth_sigma));
    v.normal = turn * v.normal;
    v.edge_pixel = -1;
    if (is_seen) moved.push_back(std::move(v));
    if (!is_seen || !goes_on) flush();
  }
  flush();
}

}  // namespace edgevo
