// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The path of the camera in one unit of length, as the scale estimators use it.
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

/// The final path in one unit of length.
struct UnitPath {
  /// Number of the unit, from 0 on: another one begins at each doubt after which nothing links the unit of
  /// length to that before (run_quality/doubtful_intervals.h).
  int unit = 0;
  /// Number of its segment.
  int segment = 0;
  /// Its poses.
  Path path;
};
/// The paths of the segments, cut where another unit begins; none is empty.
std::vector<UnitPath> paths_by_unit(const Run& run);
/// The same, where another unit begins at each frame of `begins`, indices in the source, ascending.
std::vector<UnitPath> paths_by_unit(const Run& run, const std::vector<int>& begins);

}  // namespace edgevo
