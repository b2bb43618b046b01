// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// When a frame becomes a keyframe, and when the camera is back at an older one.
//
// A keyframe is needed before the map leaves the view or before its depths are too poor for the distance
// travelled since, and not sooner: each costs an adjustment. The criteria form a list (keyframe_policy.cpp);
// the first that calls for a keyframe is the reason in frames.csv.
#include "edgevo/alignment/reference.h"
#include "edgevo/alignment/tracker.h"
#include "edgevo/core/reason.h"
#include "edgevo/tracking/keyframe_params.h"

namespace edgevo {

/// Quantities that the criteria evaluate. Flows are in pixels at kReferenceWidth (view_change.h).
struct KeyframeView {
  /// Flow of the motion from the reference to this frame, or of the motion back, whichever is larger.
  double flow_px = 0;
  /// Share of the cloud that is still in view, 0 to 1.
  double view_share = 1;
  /// Predicted `view_share` of the next frame at constant velocity, 0 to 1.
  double next_view_share = 1;
  /// Share of the cloud that leaves the view per frame.
  double view_loss = 0;
  /// Factor on the flow at which a keyframe is made: 1, down to 0.5 in an expanding view.
  double flow_factor = 1;
  /// Frames since the last keyframe, this one included.
  int frames = 1;
};

/// Measures a frame against its keyframe. Moving forward, near points leave the view; moving backward, near
/// ones enter it that the cloud does not know yet: hence the flow of the motion both ways. Default values
/// where no point can be projected. Cost: four projections per point.
KeyframeView look_at_keyframe(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref,
                              int frames);

/// The first criterion that calls for a keyframe; kNone if none does.
KeyframeReason reason_for_keyframe(const KeyframeView& view, const KeyframeParams& params);

/// The keyframe of the window that the camera is nearest to.
struct NearestKeyframe {
  /// Keyframe id; -1: no keyframe has enough of the visible points in view.
  int id = -1;
  /// Flow by the translation from that keyframe to this frame, pixels at kReferenceWidth.
  double flow_px = 0;
  /// Flow by the translation from the reference, pixels at kReferenceWidth; 0: no visible point is in front
  /// of it.
  double reference_flow_px = 0;
};
/// Searches the keyframes that have `params.min_view_share` of the cloud's visible points in view. Cost:
/// keyframes x 200 projections.
NearestKeyframe find_nearest_keyframe(const Pinhole& pinhole, const Reference& reference,
                                      const SE3& T_cam_ref, const KeyframeParams& params);

/// Whether the camera is back at a keyframe other than its reference: one that is nearer by half, and nearer
/// than keyframes are to one another, while the reference is further away than the smallest flow. At a
/// standstill all are equally near (lab 2026-11-21_return_to_a_keyframe).
bool is_back(const NearestKeyframe& nearest, int reference_id, const KeyframeParams& params);

/// Decision on a tracked frame.
struct KeyframeDecision {
  /// What happens with the frame.
  enum class Action {
    /// Nothing: it is tracked only.
    kNone,
    /// Make the frame a keyframe.
    kMake,
    /// The frame should become a keyframe, but mapping is still busy with another.
    kPostpone,
    /// Track the next frames against `return_to`.
    kReturn,
  };
  /// The decision.
  Action action = Action::kNone;
  /// The criterion that called for a keyframe.
  KeyframeReason reason = KeyframeReason::kNone;
  /// Keyframe of the window to return to; -1: none.
  int return_to = -1;
};

/// Decides on keyframes and counts the frames between them.
class KeyframePolicy {
 public:
  /// `pinhole`: of the working images.
  KeyframePolicy(const Pinhole& pinhole, const KeyframeParams& params) : pinhole_(pinhole), params_(params) {}

  /// Decides on a frame with a pose. `is_mapping_busy`: another keyframe is not finished yet.
  KeyframeDecision decide(const TrackResult& tracked, const Reference& reference, bool is_mapping_busy);
  /// Whether such a pose would call for a keyframe. Changes nothing.
  bool calls_for_keyframe(const SE3& T_cam_ref, const Reference& reference) const;

  /// True if the frame before became a keyframe.
  bool follows_keyframe() const { return frames_ == 0; }
  /// Frames in a row, up to now, that would have become keyframes had mapping not been busy.
  int postponed() const { return postponed_; }

  /// Starts over with a new map, whose last view is a keyframe.
  void restart() { frames_ = 0; }

 private:
  KeyframeView look(const SE3& T_cam_ref, const Reference& reference) const;

  Pinhole pinhole_;
  KeyframeParams params_;
  int frames_ = 0;  // with a pose, since the last keyframe
  int postponed_ = 0;
};

}  // namespace edgevo
