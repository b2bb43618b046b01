// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reference that frames are tracked against, passed from mapping to tracking.
#include <map>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/records.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Reference that a frame is tracked against: the cloud of a keyframe (the newest, unless the camera has come
/// back to an older one) and the poses of the window's keyframes. Immutable once published.
struct Reference {
  /// Id of the keyframe.
  int keyframe_id = 0;
  /// Timestamp of the keyframe's image.
  Timestamp time;
  /// Pose of the keyframe in the segment's map.
  SE3 T_ref_world;
  /// Image and points of the keyframe.
  ReferenceCloud cloud;
  /// Number of the cloud's points whose depth is known.
  int known_points = 0;
  /// Number of such points that tracking wants (Window::points_wanted).
  int wanted_points = 0;
  /// Share of all points of the window that lie in the keyframe's image, matched there or not, 0 to 1.
  double view_share = 1;
  /// Median inverse depth of the map as the newest keyframe sees it.
  double median_idepth = 1;
  /// Poses of all keyframes in the window, by id.
  std::map<int, SE3> T_keyframe_world;
  /// Camera correction that this map was made with.
  CameraPosterior camera;
  /// Number of moves of the map before this state (Map::moves()).
  int moves = 0;
  /// Variance of poses tracked against this keyframe over the variance that their alignment reports.
  double error_factor = 1;
};

}  // namespace edgevo
