// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/path.h"

namespace edgevo {

void extend(int frame_index, Timestamp time, const SE3& T_world_cam, Path* path) {
  double distance = 0;
  if (!path->empty())
    distance =
        path->back().distance + (T_world_cam.translation() - path->back().T_world_cam.translation()).norm();
  path->push_back({frame_index, time, T_world_cam, distance});
}

std::vector<Path> paths_of(const Run& run) {
  std::vector<Path> paths;
  for (const FrameRecord& frame : run.frames) {
    if (!frame.T_world_cam || frame.segment < 0) continue;
    if (size_t(frame.segment) >= paths.size()) paths.resize(size_t(frame.segment) + 1);
    extend(frame.index, frame.time, *frame.T_world_cam, &paths[size_t(frame.segment)]);
  }
  return paths;
}

}  // namespace edgevo
