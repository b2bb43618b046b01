#include "keyframe_decision.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "edgevo/alignment/projection.h"

namespace edgevo {

namespace {

constexpr double kReferenceWidth = 1241;  // the pixel thresholds are stated at this width
constexpr double kReachOfOpeningView = 0.5;  // share of the flow that a keyframe may lie away where the view opens: share/lab/mapping.md, "Backwards"

// Image motion by the translation from a keyframe to the camera, of points given in the camera (rays and inverse depths).
struct Parallax {
  double flow_px = 0, view_share = 0;
};

Parallax parallax(const Pinhole& pinhole, const std::vector<CloudPoint>& seen, const SE3& T_keyframe_cam) {
  const Eigen::Matrix3d R = T_keyframe_cam.R();
  const Eigen::Vector3d t = R.transpose() * T_keyframe_cam.translation();  // in the camera's axes: the rotation left out
  double square = 0;
  int counted = 0, in_view = 0;
  for (const CloudPoint& p : seen) {
    const Projection there = project(pinhole, R, T_keyframe_cam.translation(), p.ray, p.idepth);
    if (there.valid && pinhole.contains(there.px)) ++in_view;
    const Projection moved = project(pinhole, Eigen::Matrix3d::Identity(), t, p.ray, p.idepth);
    if (!moved.valid) continue;
    square += (moved.px - pinhole.project(p.ray)).squaredNorm();
    ++counted;
  }
  if (counted == 0) return {};
  return {std::sqrt(square / counted), double(in_view) / double(seen.size())};
}

// How a view of `points` changes by a motion: rms image motion by the translation alone, and the share of them that stays in view.
struct ViewChange {
  double flow_px = 0, view_share = 0;
};

// None where all are behind the camera then.
std::optional<ViewChange> view_change(const Pinhole& pinhole, const std::vector<CloudPoint>& points, const SE3& T_to_from) {
  const Eigen::Matrix3d R = T_to_from.R();
  const Eigen::Vector3d t = T_to_from.translation();
  double square = 0;
  int counted = 0, in_view = 0;
  for (const CloudPoint& p : points) {
    const Projection moved = project(pinhole, R, t, p.ray, p.idepth);
    if (moved.valid && pinhole.contains(moved.px)) ++in_view;
    const Projection turned = project(pinhole, R, Eigen::Vector3d::Zero(), p.ray, p.idepth);
    if (!moved.valid || !turned.valid) continue;
    square += (moved.px - turned.px).squaredNorm();
    ++counted;
  }
  if (counted == 0) return std::nullopt;
  return ViewChange{std::sqrt(square / counted), double(in_view) / double(points.size())};
}

// What the cloud does not know comes into view when the camera backs away, and it is the nearest of the scene. A view like the
// reference's own, left by the motion back, tells how fast: 0 where that makes no more flow than the motion out, up to 1.
double opening(const ViewChange& out, const ViewChange& back) {
  constexpr double kFullyOpening = 0.15;  // on a drive backwards it is 0.1 to 0.4, of a camera moved about by hand within 0.1
  if (!(back.flow_px > out.flow_px)) return 0;
  return std::min(1.0, (back.flow_px - out.flow_px) / (kFullyOpening * out.flow_px));
}

// Up to `count` points of the cloud that the camera sees, in its own frame.
std::vector<CloudPoint> visible_points(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref, size_t count) {
  std::vector<CloudPoint> seen;
  const size_t step = std::max<size_t>(1, cloud.points.size() / count);
  for (size_t i = 0; i < cloud.points.size(); i += step) {
    CloudPoint p = cloud.points[i];
    const Eigen::Vector3d Y = T_cam_ref.R() * p.ray + p.idepth * T_cam_ref.translation();
    if (!(Y.z() > kMinProjectedDepth) || !pinhole.contains(pinhole.project(Y))) continue;
    p.idepth /= Y.z();
    p.ray = Y / Y.z();
    seen.push_back(p);
  }
  return seen;
}

// The map explains less and less of what the camera sees: its depths are not good enough for the way gone since. Where points find no
// edges at all, or the share was never high, it is the light instead, and a keyframe in bad light does harm.
bool is_stale(const ReferenceFit& fit, const KeyframeParams& params) {
  constexpr double kGoodMatchedShare = 0.84, kGoodInlierShare = 0.85;
  return fit.matched_share >= kGoodMatchedShare && fit.best_inlier_share >= kGoodInlierShare &&
         fit.inlier_share < params.min_inlier_ratio * fit.best_inlier_share;
}

}  // namespace

NearestKeyframe find_nearest_keyframe(const Pinhole& pinhole, const Reference& reference, const SE3& T_cam_ref,
                                      const KeyframeParams& params) {
  constexpr size_t kPoints = 200;
  const std::vector<CloudPoint> seen = visible_points(pinhole, reference.cloud, T_cam_ref, kPoints);
  const SE3 T_world_cam = (T_cam_ref * reference.T_ref_world).inverse();
  NearestKeyframe nearest;
  for (const auto& [id, T_keyframe_world] : reference.T_keyframe_world) {
    const Parallax p = parallax(pinhole, seen, T_keyframe_world * T_world_cam);
    if (p.view_share < params.min_view_share) continue;
    if (nearest.id < 0 || p.flow_px < nearest.flow_px) nearest = {id, p.flow_px};
  }
  return nearest;
}

bool is_back(const Pinhole& pinhole, const NearestKeyframe& nearest, int reference_id, double flow_px, const KeyframeParams& params) {
  constexpr double kBackShare = 0.5;
  const double scale = kReferenceWidth / pinhole.width;
  // Further on than a keyframe's distance it is no return: after a jump all keyframes are far, the reference only furthest.
  return nearest.id >= 0 && nearest.id != reference_id && nearest.flow_px < kBackShare * flow_px &&
         nearest.flow_px * scale < params.flow_px && flow_px * scale > params.min_flow_px;
}

KeyframeDecision decide_keyframe(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref,
                                 int frames_since_keyframe, const ReferenceFit& fit, const KeyframeParams& params) {
  KeyframeDecision d;
  const std::optional<ViewChange> out = view_change(pinhole, cloud.points, T_cam_ref);
  if (!out) return d;
  const ViewChange back = view_change(pinhole, cloud.points, T_cam_ref.inverse()).value_or(*out);
  d.flow_px = std::max(out->flow_px, back.flow_px);
  d.view_share = out->view_share;
  const double scale = kReferenceWidth / pinhole.width;
  const double flow = d.flow_px * scale, reach = 1 - (1 - kReachOfOpeningView) * opening(*out, back);
  // Of the next frame, if the motion goes on.
  const double growth = 1.0 + 1.0 / std::max(1, frames_since_keyframe);
  const double next_flow = growth * flow, next_view_share = 1.0 - growth * (1.0 - d.view_share);
  const double view_loss = (1.0 - d.view_share) / std::max(1, frames_since_keyframe);  // a frame
  // At a standstill or in a pure rotation a keyframe brings matches but no depth: there is one only to follow the rotation.
  d.needed = flow > reach * params.flow_px || d.view_share < params.min_turn_share ||
             (flow > params.min_flow_px &&
              (next_flow > reach * params.max_flow_px || next_view_share < params.min_view_share || view_loss > params.max_view_loss ||
               is_stale(fit, params) || frames_since_keyframe >= params.max_frames));
  return d;
}

}  // namespace edgevo
