#pragma once
// When a frame becomes a keyframe, and when the camera is back at an older one.
//
// A keyframe is needed before the map leaves the view or its depths are too poor for the way gone since, and
// not sooner: each costs an adjustment. The criteria stand in a list (keyframe_policy.cpp); the first that
// calls for a keyframe is its reason in frames.csv.
#include "edgevo/alignment/tracker.h"
#include "edgevo/core/keyframe_reason.h"
#include "edgevo/odometry/keyframe_params.h"
#include "edgevo/odometry/reference.h"

namespace edgevo {

/// What the criteria look at. Flows in pixels at kReferenceWidth (view_change.h).
struct KeyframeView {
  double flow_px =
      0;  ///< by the motion from the reference to here or by the motion back, whichever is larger
  double view_share = 1;       ///< of the cloud, still in view
  double next_view_share = 1;  ///< of the next frame, if the motion goes on
  double view_loss = 0;        ///< share of the cloud that has left the view, a frame
  double reach = 1;  ///< share of the usual flow that a keyframe may lie away: 0.5 where the view opens
  int frames = 1;    ///< since the last keyframe, this one included
};

/// Going forward near things leave the view; going backward near ones come into it that the cloud does not
/// know yet: hence the motion both ways. Nothing is needed where no point can be projected. Cost: four
/// projections a point.
KeyframeView look_at_keyframe(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref,
                              int frames);

/// The first criterion that calls for a keyframe; kNone where none does.
KeyframeReason reason_for_keyframe(const KeyframeView& view, const KeyframeParams& params);

/// Of the keyframes of the window, the one that the camera stands nearest to.
struct NearestKeyframe {
  int id = -1;                   ///< -1: none has enough of what is seen in view
  double flow_px = 0;            ///< image motion by the translation from there to here, at kReferenceWidth
  double reference_flow_px = 0;  ///< the same from the reference; 0: none of what is seen lies before it
};
/// Among those that have `params.min_view_share` of the cloud's visible points in view. Cost: keyframes x 200
/// projections.
NearestKeyframe find_nearest_keyframe(const Pinhole& pinhole, const Reference& reference,
                                      const SE3& T_cam_ref, const KeyframeParams& params);

/// Is the camera back at another keyframe than its reference? One that is nearer by half, and nearer than
/// keyframes lie to one another; and the reference is left by more than the smallest flow: at a standstill
/// all are equally near (share/lab/archive/2026-11-21_return_to_a_keyframe.md).
bool is_back(const NearestKeyframe& nearest, int reference_id, const KeyframeParams& params);

struct KeyframeDecision {
  enum class Action {
    kNone,
    kMake,      ///< the frame becomes a keyframe
    kPostpone,  ///< it would, but the mapping is still busy with another
    kReturn,    ///< what follows is tracked against `return_to`
  };
  Action action = Action::kNone;
  /// What called for it.
  KeyframeReason reason = KeyframeReason::kNone;
  int return_to = -1;  ///< a keyframe of the window
};

/// Counts the frames between keyframes.
class KeyframePolicy {
 public:
  KeyframePolicy(const Pinhole& pinhole, const KeyframeParams& params) : pinhole_(pinhole), params_(params) {}

  /// Of a frame with a pose. `is_mapping_busy`: another keyframe is not finished yet.
  KeyframeDecision decide(const TrackResult& tracked, const Reference& reference, bool is_mapping_busy);
  /// Would such a pose call for a keyframe? Changes nothing.
  bool calls_for_keyframe(const SE3& T_cam_ref, const Reference& reference) const;

  /// The frame before was made a keyframe.
  bool follows_keyframe() const { return frames_ == 0; }
  /// Frames in a row, up to now, that would have been keyframes had the mapping not been busy.
  int postponed() const { return postponed_; }

  /// A new map: its last view is a keyframe.
  void restart() { frames_ = 0; }

 private:
  KeyframeView look(const SE3& T_cam_ref, const Reference& reference) const;

  Pinhole pinhole_;
  KeyframeParams params_;
  int frames_ = 0;  // with a pose, since the last keyframe
  int postponed_ = 0;
};

}  // namespace edgevo
