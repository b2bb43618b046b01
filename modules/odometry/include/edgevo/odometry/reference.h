#pragma once
// What frames are tracked against: the hand-over from the mapping side to the tracking side.
#include <map>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/records.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// What a frame is tracked against: the cloud of a keyframe, the newest unless the camera has come back to an
/// older one, and where the window's keyframes stand. Immutable once handed out.
struct Reference {
  int keyframe_id = 0;  ///< of the keyframe
  SE3 T_ref_world;  ///< of the segment's map
  ReferenceCloud cloud;  ///< its image and points
  int known_points = 0;   ///< of the cloud's points, those of known depth
  double view_share = 1;  ///< of all points of the window, those that lie in its image, matched there or not
  double median_idepth = 1;             ///< of the map where the newest keyframe sees it
  std::map<int, SE3> T_keyframe_world;  ///< of all keyframes in the window
  CameraRefinement camera;              ///< that this map was made with
  double error_factor =
      1;  ///< variance of poses tracked against it, over the covariance that their alignment tells
};

}  // namespace edgevo
