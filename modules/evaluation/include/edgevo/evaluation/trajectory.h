// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Strict readers of trajectory files.
//
// TUM    one pose a line: t tx ty tz qx qy qz qw   (seconds; T_world_cam, camera x right, y down, z forward)
// KITTI  one pose a line: the first three rows of T_world_cam, row by row (12 numbers); no times, one line a
// frame
//
// Fields are separated by any number of blanks or tabs; lines may end in CR LF; empty lines and lines that
// begin with # are skipped. The number of fields of the first pose (8 or 12) determines the format.
// Errors: InputError "FILE:LINE: ..." for anything that is not a finite number, a wrong number of fields, an
// invalid rotation, times that do not increase. Cost: linear. Threads: no state.
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Format of a trajectory file.
enum class TrajectoryFormat { kTum, kKitti };

/// Name of the format: "TUM", "KITTI".
std::string_view to_string(TrajectoryFormat format);

/// A pose with its time: one line of a file.
struct StampedPose {
  /// Time; in a KITTI file the number of the line, in seconds.
  Timestamp time;
  /// Pose, in the unit of the file: metres in ground truth, arbitrary in a monocular estimate.
  SE3 T_world_cam;
};

/// Contents of a trajectory file.
struct Trajectory {
  /// Path of the file, for messages.
  std::string path;
  /// Format of the file.
  TrajectoryFormat format = TrajectoryFormat::kTum;
  /// Poses with increasing times.
  std::vector<StampedPose> poses;
};

/// The final poses of a run, without those that are not finite.
Trajectory trajectory_of(const Run& run);

/// Reads a file. Throws InputError if it cannot be read or contains no pose.
Trajectory read_trajectory(const std::string& path);

/// As read_trajectory(), from text; `where` starts each error message.
Trajectory parse_trajectory(std::string_view text, const std::string& where);

}  // namespace edgevo
