#pragma once
// The way of the camera through one segment, as the scale estimators read it.
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// One frame of the path.
struct PathPose {
  int frame_index = 0;  ///< in the source
  Timestamp time;  ///< of the frame
  SE3 T_world_cam;  ///< units of the run
  double way = 0;  ///< length of the path up to here, units of the run
};

/// In time order; `way` never falls.
using Path = std::vector<PathPose>;

/// Appends a pose, its way included.
void extend(int frame_index, Timestamp time, const SE3& T_world_cam, Path* path);

/// The final poses of each segment's frames, by segment number; a segment without poses has an empty path.
std::vector<Path> paths_of(const Run& run);

}  // namespace edgevo
