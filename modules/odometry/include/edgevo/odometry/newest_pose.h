#pragma once
// What is known when a frame has just been processed, for whoever acts on it at once: a servo loop, a window
// on the screen.
#include <memory>
#include <optional>
#include <string>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/core/tracking_state.h"
#include "edgevo/odometry/reference.h"

namespace edgevo {

/// A snapshot: what it points to never changes. Lengths are in the unit of the segment's map, which has its
/// origin at the segment's first keyframe. Cheap to copy.
struct NewestPose {
  int frame_index = -1;  ///< -1: no frame yet
  Timestamp time;        ///< of the image
  TrackingState state = TrackingState::kBootstrapping;  ///< the verdict
  std::string note;  ///< why it is not TRACKING; else empty
  int segment = -1;  ///< poses of two segments have no common frame that could be trusted
  std::optional<SE3>
      T_cam_map;  ///< against the keyframe poses of `reference`; none while LOST or BOOTSTRAPPING
  /// Of xi in T_cam_map <- exp(xi) T_cam_map, tangent [v, w]; the scale taken as known (alignment/pose_covariance.h). Zero: unknown.
  Matrix6d covariance = Matrix6d::Zero();
  std::shared_ptr<const Reference> reference;  ///< what the frame was tracked against; null without a map
};

}  // namespace edgevo
