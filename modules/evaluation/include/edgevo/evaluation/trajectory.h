#pragma once
// Trajectory files, strictly read.
//
// TUM    one pose a line: t tx ty tz qx qy qz qw   (seconds; T_world_cam, camera x right, y down, z forward)
// KITTI  one pose a line: the first three rows of T_world_cam, row by row (12 numbers); no times, one line a frame
//
// Fields are separated by any number of blanks or tabs; lines may end in CR LF; empty lines and lines that begin with #
// are passed over. The format follows from the number of fields of the first pose (8 or 12).
// Errors: InputError "FILE:LINE: ..." for anything that is not a finite number, a wrong number of fields, a rotation that
// is none, times that do not increase. Cost: linear. Threads: no state.
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// The two formats above.
enum class TrajectoryFormat { kTum, kKitti };

/// "TUM", "KITTI".
std::string_view to_string(TrajectoryFormat format);

/// One line of the file.
struct StampedPose {
  Timestamp time;  ///< KITTI: the number of the row, in seconds
  SE3 T_world_cam;  ///< translation in the file's own unit: metres in a ground truth, arbitrary in a monocular estimate
};

/// A trajectory file.
struct Trajectory {
  std::string path;                              ///< file it came from, for messages
  TrajectoryFormat format = TrajectoryFormat::kTum;  ///< of the file
  std::vector<StampedPose> poses;                ///< times increase; a KITTI row's time is its number, in seconds
};

/// Throws InputError if the file cannot be read or holds no pose.
Trajectory read_trajectory(const std::string& path);

/// As read_trajectory, from text; `where` opens each error message.
Trajectory parse_trajectory(std::string_view text, const std::string& where);

}  // namespace edgevo
