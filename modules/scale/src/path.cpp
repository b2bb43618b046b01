// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/path.h"

#include <map>
#include <utility>

#include "edgevo/run_quality/doubtful_intervals.h"

namespace edgevo {

void extend(int frame_index, Timestamp time, const SE3& T_world_cam, Path* path) {
  double distance = 0;
  if (!path->empty())
    distance =
        path->back().distance + (T_world_cam.translation() - path->back().T_world_cam.translation()).norm();
  path->push_back({frame_index, time, T_world_cam, distance});
}

std::vector<UnitPath> paths_by_unit(const Run& run) {
  std::vector<int> begins;
  for (const DoubtfulInterval& interval : doubtful_intervals(run))
    if (interval.is_scale_unresolved()) begins.push_back(interval.first_frame);
  return paths_by_unit(run, begins);
}

std::vector<UnitPath> paths_by_unit(const Run& run, const std::vector<int>& begins) {
  std::map<std::pair<int, int>, Path> paths;  // by segment and unit
  size_t unit = 0;
  for (const FrameRecord& frame : run.frames) {
    while (unit < begins.size() && frame.index >= begins[unit]) ++unit;
    if (!frame.T_world_cam || frame.segment < 0) continue;
    extend(frame.index, frame.time, *frame.T_world_cam, &paths[{frame.segment, int(unit)}]);
  }
  std::vector<UnitPath> by_unit;
  for (auto& [key, path] : paths) by_unit.push_back({key.second, key.first, std::move(path)});
  return by_unit;
}

}  // namespace edgevo
