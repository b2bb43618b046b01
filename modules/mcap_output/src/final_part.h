// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is known at the end of a run: final poses, lines, grid.
#include <optional>

#include "edgevo/core/occupancy_grid.h"
#include "edgevo/core/records.h"
#include "ros_messages.h"
#include "topics.h"

namespace edgevo {

/// Where the run ends, as it was written so far.
struct LiveEnd {
  /// Time of the newest frame.
  Timestamp time;
  /// From the camera to base_link.
  SE3 T_base_cam;
  /// Time and pose of the last frame that has one; nothing if none has.
  std::optional<std::pair<Timestamp, SE3>> T_odom_base;
};

/// Where `odom` lies at last, so that the newest pose is the final one; nothing without a pose.
std::optional<SE3> final_T_map_odom(const Run& run, const LiveEnd& end);
/// Writes the path and, without null, the grid, and the lines anew, which replace those of before. Lengths
/// are to be those of the file.
void write_final_part(const Run& run, const OccupancyGrid* grid, const LiveEnd& end, TopicFile* file);

}  // namespace edgevo
