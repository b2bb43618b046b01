// SPDX-License-Identifier: BSD-3-Clause
#include "missing_causes.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr int kFewFrames = 4;     // any depth by images needs more than two: the third confirms it
constexpr double kShownPx = 1;    // across the edge: less is lost in the errors of edges and poses
constexpr int kShortPx = 12;      // of an edge
constexpr double kFarther = 1.6;  // times: from so far, edges run together
constexpr double kBorderPx = 3;

// Whether the frame has a surface of this depth next to the pixel.
bool is_seen(const std::vector<float>& depth, const Pinhole& p, const Eigen::Vector2d& px, double z,
             double share) {
  const int u = int(std::lround(px.x())), v = int(std::lround(px.y()));
  for (int y = v - 1; y <= v + 1; ++y)
    for (int x = u - 1; x <= u + 1; ++x) {
      const double there = double(depth[size_t(y) * size_t(p.width) + size_t(x)]);
      if (there > 0 && std::abs(there - z) <= share * there) return true;
    }
  return false;
}

void look_from(const SE3& T_cam_scene, const std::vector<float>& depth, const Pinhole& p, double share,
               MissingEdge* e) {
  const Eigen::Vector3d here = T_cam_scene * e->at;
  if (!(here.z() > 0) || here.z() > kFarther * e->depth) return;
  const Eigen::Vector2d px = p.project(here);
  if (!p.contains(px, kBorderPx) || !is_seen(depth, p, px, here.z(), share)) return;
  ++e->frames;
  const Eigen::Vector3d farther = T_cam_scene * e->farther, next = T_cam_scene * e->next;
  if (!(farther.z() > 0) || !(next.z() > 0)) return;
  const Eigen::Vector2d moved = p.project(farther) - px, along = (p.project(next) - px).normalized();
  e->moved_px = std::max(e->moved_px, moved.norm());
  e->across_px = std::max(e->across_px, std::abs(moved.x() * along.y() - moved.y() * along.x()));
}

}  // namespace

MissingEdge::MissingEdge(const TrueEdgePixel& edge, const SE3& T_scene_cam, const Pinhole& pinhole,
                         double depth_share)
    : at(T_scene_cam * (edge.depth * pinhole.ray(edge.px))),
      next(T_scene_cam * edge.next),
      farther(T_scene_cam * ((1 + depth_share) * edge.depth * pinhole.ray(edge.px))),
      depth(edge.depth),
      thing(edge.thing),
      is_short(edge.length_px < kShortPx) {}

void look_from_all_frames(const SceneRenderer& scene, int begin, int end, double depth_share,
                          std::vector<MissingEdge>* edges) {
  const Pinhole p = scene.undistorted();
  for (int i = begin; i < end; ++i) {
    const std::vector<float> depth = scene.render_depth(i);
    const SE3 T_cam_scene = scene.scene().T_scene_cam[size_t(i)].inverse();
    for (MissingEdge& e : *edges) look_from(T_cam_scene, depth, p, depth_share, &e);
  }
}

MissingCause cause_of(const MissingEdge& e) {
  if (e.is_misplaced) return MissingCause::kWrongDepth;
  if (e.frames < kFewFrames) return MissingCause::kFewFrames;
  if (e.moved_px < kShownPx) return MissingCause::kStill;
  if (e.across_px < kShownPx) return MissingCause::kAlongMotion;
  return e.is_short ? MissingCause::kShort : MissingCause::kNoLine;
}

}  // namespace edgevo
