#pragma once
// When a frame becomes a keyframe, and when the camera is back at one that the window has.
#include "edgevo/core/camera.h"
#include "edgevo/mapping/mapping_params.h"
#include "edgevo/odometry/reference.h"

namespace edgevo {

/// The keyframe of the window whose view is most like the present one.
struct NearestKeyframe {
  int id = -1;
  double flow_px = 0;        ///< rms image motion of the cloud by the translation from there to here
};
/// Among the keyframes that have `params.min_view_share` of the cloud's visible points in view. Cost: keyframes x 200 projections.
NearestKeyframe find_nearest_keyframe(const Pinhole& pinhole, const Reference& reference, const SE3& T_cam_ref,
                                      const KeyframeParams& params);

/// Is the camera back at another keyframe than its reference? One that is nearer by half, and nearer than keyframes lie to one another; and the
/// reference is left by more than the smallest flow: at a standstill all are equally near.
bool is_back(const Pinhole& pinhole, const NearestKeyframe& nearest, int reference_id, double flow_px, const KeyframeParams& params);

/// How well a reference explains the frames tracked against it, shares in [0, 1].
struct ReferenceFit {
  double matched_share = 1;      ///< AlignmentStats::matched_share() of this frame
  double inlier_share = 1;       ///< PoseEvidence::inlier_share of this frame
  double best_inlier_share = 1;  ///< of all the frames
};

/// Should this frame become a keyframe? The flow is that of the motion from the reference to here or of the motion back, whichever is
/// larger: going forward near things leave the view, going backward as near ones come into it, that the cloud does not know yet.
struct KeyframeDecision {
  bool needed = false;
  double flow_px = 0;        ///< rms image motion of the cloud by the translation alone
  double view_share = 1;     ///< of the cloud, still in view
};
/// Where the view opens (backward motion among near things) a keyframe comes at down to half the flow. Cost: four projections a point.
KeyframeDecision decide_keyframe(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref,
                                 int frames_since_keyframe, const ReferenceFit& fit, const KeyframeParams& params);

}  // namespace edgevo
