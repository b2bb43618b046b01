// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The path of the camera through one segment, as the scale estimators use it.
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// One frame of the path.
struct PathPose {
  /// Index of the frame in the source.
  int frame_index = 0;
  /// Time of the frame.
  Timestamp time;
  /// Pose of the camera, units of the run.
  SE3 T_world_cam;
  /// Travelled distance along the path up to this pose, units of the run.
  double distance = 0;
};

/// Poses in time order; `distance` never decreases.
using Path = std::vector<PathPose>;

/// Appends a pose and computes its travelled distance.
void extend(int frame_index, Timestamp time, const SE3& T_world_cam, Path* path);

/// Final poses of each segment's frames, by segment number; the path of a segment without poses is empty.
std::vector<Path> paths_of(const Run& run);

}  // namespace edgevo
