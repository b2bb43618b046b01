// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/keyframe_policy.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "view_change.h"

namespace edgevo {
namespace {

// How fast the view expands, 0 to 1. When the camera backs away, points that the cloud does not know come
// into view, and they are the nearest of the scene. A view like the reference's own, moved by the motion
// back, shows how fast: 0 if that makes no more flow than the motion out
// (lab 2026-11-23_backward_motion).
double expansion(const ViewChange& out, const ViewChange& back) {
  // Excess of the flow back: 0.1 to 0.4 when driving backwards, within 0.1 by hand.
  constexpr double kFullExpansion = 0.15;
  if (!(back.flow_px > out.flow_px)) return 0;
  return std::min(1.0, (back.flow_px - out.flow_px) / (kFullExpansion * out.flow_px));
}

// At a standstill or in a pure rotation a keyframe brings matches but no depth: one is made only to follow
// the rotation.
bool moves(const KeyframeView& v, const KeyframeParams& p) { return v.flow_px > p.min_flow_px; }

// Flow that calls for a keyframe, pixels.
double keyframe_flow_px(const KeyframeView& v, const KeyframeParams& p) {
  return p.shorten_in_expanding_view ? v.flow_factor * p.flow_px : p.flow_px;
}

struct Criterion {
  KeyframeReason reason;
  bool (*calls)(const KeyframeView&, const KeyframeParams&);
};

// The criteria in order. To add one: a line here, its KeyframeReason, and a test in keyframe_policy_test.cpp.
constexpr Criterion kCriteria[] = {
    {KeyframeReason::kParallax,
     [](const KeyframeView& v, const KeyframeParams& p) { return v.flow_px > keyframe_flow_px(v, p); }},
    {KeyframeReason::kRotation,
     [](const KeyframeView& v, const KeyframeParams& p) { return v.view_share < p.min_turn_share; }},
    {KeyframeReason::kViewLeaves,
     [](const KeyframeView& v, const KeyframeParams& p) {
       return moves(v, p) && v.next_view_share < p.min_view_share;
     }},
    {KeyframeReason::kFastTurn,
     [](const KeyframeView& v, const KeyframeParams& p) {
       return moves(v, p) && v.view_loss > p.max_view_loss;
     }},
    {KeyframeReason::kLongSince,
     [](const KeyframeView& v, const KeyframeParams& p) { return moves(v, p) && v.frames >= p.max_frames; }},
};

}  // namespace

KeyframeView look_at_keyframe(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref,
                              int frames) {
  // Share of flow_px: what comes into view is nearer by half and more.
  constexpr double kExpandingViewFactor = 0.5;
  KeyframeView v;
  v.frames = frames;
  const std::optional<ViewChange> out = view_change(pinhole, cloud.points, T_cam_ref);
  if (!out) return v;
  const ViewChange back = view_change(pinhole, cloud.points, T_cam_ref.inverse()).value_or(*out);
  v.flow_px = at_reference_width(pinhole, std::max(out->flow_px, back.flow_px));
  v.view_share = out->view_share;
  v.flow_factor = 1 - (1 - kExpandingViewFactor) * expansion(*out, back);
  const double growth = 1.0 + 1.0 / std::max(1, frames);
  v.next_view_share = 1.0 - growth * (1.0 - v.view_share);
  v.view_loss = (1.0 - v.view_share) / std::max(1, frames);
  return v;
}

KeyframeReason reason_for_keyframe(const KeyframeView& view, const KeyframeParams& params) {
  const auto* first = std::find_if(std::begin(kCriteria), std::end(kCriteria),
                                   [&](const Criterion& c) { return c.calls(view, params); });
  return first != std::end(kCriteria) ? first->reason : KeyframeReason::kNone;
}

NearestKeyframe find_nearest_keyframe(const Pinhole& pinhole, const Reference& reference,
                                      const SE3& T_cam_ref, const KeyframeParams& params) {
  constexpr size_t kPoints = 200;  // enough for an rms
  const std::vector<CloudPoint> seen = visible_points(pinhole, reference.cloud, T_cam_ref, kPoints);
  const SE3 T_world_cam = (T_cam_ref * reference.T_ref_world).inverse();
  NearestKeyframe nearest;
  for (const auto& [id, T_keyframe_world] : reference.T_keyframe_world) {
    const auto change = view_change(pinhole, seen, T_keyframe_world * T_world_cam);
    if (!change) continue;
    const double flow_px = at_reference_width(pinhole, change->flow_px);
    if (id == reference.keyframe_id) nearest.reference_flow_px = flow_px;
    if (change->view_share < params.min_view_share) continue;
    if (nearest.id < 0 || flow_px < nearest.flow_px) nearest.id = id, nearest.flow_px = flow_px;
  }
  return nearest;
}

bool is_back(const NearestKeyframe& nearest, int reference_id, const KeyframeParams& params) {
  // Share of the flow to the reference: nearer by half is nearer whatever the noise.
  constexpr double kBackShare = 0.5;
  // Beyond a keyframe's distance it is no return: after a jump all keyframes are far away, and the reference
  // is merely the furthest.
  return nearest.id >= 0 && nearest.id != reference_id &&
         nearest.flow_px < kBackShare * nearest.reference_flow_px && nearest.flow_px < params.flow_px &&
         nearest.reference_flow_px > params.min_flow_px;
}

KeyframeView KeyframePolicy::look(const SE3& T_cam_ref, const Reference& reference) const {
  return look_at_keyframe(pinhole_, reference.cloud, T_cam_ref, frames_ + 1);
}

bool KeyframePolicy::calls_for_keyframe(const SE3& T_cam_ref, const Reference& reference) const {
  return reason_for_keyframe(look(T_cam_ref, reference), params_) != KeyframeReason::kNone;
}

KeyframeDecision KeyframePolicy::decide(const TrackResult& tracked, const Reference& reference,
                                        bool is_mapping_busy) {
  using Action = KeyframeDecision::Action;
  const KeyframeView view = look(tracked.T_cur_ref, reference);
  const NearestKeyframe nearest = find_nearest_keyframe(pinhole_, reference, tracked.T_cur_ref, params_);
  const KeyframeReason reason = reason_for_keyframe(view, params_);
  const bool is_called_for = reason != KeyframeReason::kNone;
  ++frames_;
  postponed_ = is_called_for && is_mapping_busy ? postponed_ + 1 : 0;
  if (params_.return_to_keyframes && is_back(nearest, reference.keyframe_id, params_))
    return {Action::kReturn, KeyframeReason::kReturn, nearest.id};
  if (!is_called_for) return {};
  if (is_mapping_busy) return {Action::kPostpone, reason};
  frames_ = 0;
  return {Action::kMake, reason};
}

}  // namespace edgevo
