// SPDX-License-Identifier: BSD-3-Clause
// The window after a correction of the camera: everything measured in its images moves with them.
#include <algorithm>

#include "edgevo/mapping/window.h"

namespace edgevo {
namespace {

// An edge pixel of the new image within this distance in pixels, and within 37 degrees of the old direction,
// is the old one: a resampled edge may be found a pixel's diagonal off, and a neighbouring edge is further
// away.
constexpr double kSameEdgePx = 1.5;
constexpr double kSameEdgeCosine = 0.8;

int find_edge_pixel(const PyramidLevel& level, const Eigen::Vector2d& px, const Eigen::Vector2d& normal) {
  if (!level.pinhole.contains(px)) return -1;
  const int n = level.field.nearest(float(px.x()), float(px.y()));
  if (n < 0) return -1;
  const EdgePixel& e = level.edges.pixels[n];
  const bool same = (e.position().cast<double>() - px).norm() < kSameEdgePx &&
                    e.normal().cast<double>().dot(normal) > kSameEdgeCosine;
  return same ? n : -1;
}

void correct_match(const Pinhole& c, const MapRevision& revision, int keyframe_id, Match* m) {
  const ImageMotion& motion = revision.motion_of(keyframe_id);
  m->normal = correct_normal(c, revision.before, revision.now, motion, m->px, m->normal);
  m->px = correct_pixel(c, revision.before, revision.now, motion, m->px);
}

void revise_points(const Pinhole& c, const MapRevision& revision, const RevisedKeyframe& r, Keyframe* k) {
  for (size_t i = 0; i < k->points.size(); ++i) {
    MapPoint& p = k->points[i];
    p.normal = correct_normal(c, revision.before, revision.now, r.motion, p.px, p.normal);
    p.px = r.points[i].px;
    p.idepth_sigma /= r.length_ratio;
    p.idepth = r.points[i].idepth;
    p.edge_pixel = find_edge_pixel(k->pyramid->finest(), p.px, p.normal);
    for (Observation& o : p.observations) correct_match(c, revision, o.keyframe_id, &o.match);
  }
}

// Immature points lie on edge pixels: those without one in the new image are dropped.
void revise_immature(const Pinhole& c, const MapRevision& revision, const RevisedKeyframe& r, Keyframe* k) {
  std::vector<ImmaturePoint> kept;
  for (ImmaturePoint p : k->immature) {
    p.normal = correct_normal(c, revision.before, revision.now, r.motion, p.px, p.normal);
    p.px = correct_pixel(c, revision.before, revision.now, r.motion, p.px);
    p.edge_pixel = find_edge_pixel(k->pyramid->finest(), p.px, p.normal);
    if (p.edge_pixel < 0) continue;
    p.idepth /= r.length_ratio;
    p.idepth_sigma /= r.length_ratio;
    p.idepth_guess /= r.length_ratio;
    kept.push_back(p);
  }
  std::stable_sort(kept.begin(), kept.end(), [](const ImmaturePoint& a, const ImmaturePoint& b) {
    return a.edge_pixel < b.edge_pixel;
  });
  k->immature = std::move(kept);
}

Eigen::Vector3d correct_ray(const Pinhole& c, const MapRevision& revision, const ImageMotion& motion,
                            const Eigen::Vector3d& ray) {
  return c.ray(correct_pixel(c, revision.before, revision.now, motion, c.project(ray)));
}

void revise_corners(const Pinhole& c, const MapRevision& revision, const RevisedKeyframe& r, Keyframe* k) {
  for (CornerPair& corner : k->corners) {
    corner.from = correct_ray(c, revision, revision.motion_of(k->corners_from), corner.from);
    corner.to = correct_ray(c, revision, r.motion, corner.to);
  }
}

}  // namespace

void Window::apply(const MapRevision& revision, const Rebuild& rebuild) {
  for (Keyframe& k : keyframes_) {
    const auto r = std::find_if(revision.keyframes.begin(), revision.keyframes.end(),
                                [&](const RevisedKeyframe& c) { return c.id == k.id; });
    if (r == revision.keyframes.end()) continue;
    k.T_cam_world = r->T_cam_world;
    k.pyramid = rebuild(k);
    revise_points(pinhole_, revision, *r, &k);
    revise_immature(pinhole_, revision, *r, &k);
    revise_corners(pinhole_, revision, *r, &k);
  }
  if (!revision.prior.pose_ids.empty()) {
    prior_ = revision.prior;
    bootstrap_gauge_ = false;
  }
}

}  // namespace edgevo
