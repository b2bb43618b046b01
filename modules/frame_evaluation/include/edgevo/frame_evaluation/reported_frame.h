// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a run said about each of its frames, to compare it with the truth (evaluate_frames.h): from a Run in
// memory, or from the folder of a run (frames.csv with its trajectories).
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Which poses of a run.
enum class PoseSource {
  /// As known when the frame was processed: what a planner got.
  kLive,
  /// As known at the end: what the map is made of.
  kFinal,
};

/// One input frame and what the run said about it.
struct ReportedFrame {
  /// Index in the source.
  int index = 0;
  /// Time of exposure.
  Timestamp time;
  /// Tracking state.
  TrackingState state = TrackingState::kBootstrapping;
  /// Number of the segment; -1: none.
  int segment = -1;
  /// FrameRecord::p_right; NaN: unknown.
  double p_right = std::numeric_limits<double>::quiet_NaN();
  /// FrameEvidence::median_depth, in the unit of the poses; NaN: unknown.
  double median_depth = std::numeric_limits<double>::quiet_NaN();
  /// Pose, in the unit of the run; nothing if there is none, or none that is finite.
  std::optional<SE3> T_world_cam;
  /// FrameRecord::covariance; zero: unknown.
  Matrix6d covariance = Matrix6d::Zero();
  /// Position in the list of the frame whose keyframe the covariance is relative to; -1: unknown.
  int reference = -1;
};

/// The reports of a run, one for each input frame.
std::vector<ReportedFrame> reported_frames(const Run& run, PoseSource poses);

/// The reports in the folder of a run: `frames.csv` with `trajectory_live_tum.txt` or `trajectory_tum.txt`,
/// and `covariances.csv` if there is one. Columns are found by their names; `p_right` and `median_depth` may
/// be missing (unknown then). Throws InputError for a file that is missing or broken. Cost: linear.
std::vector<ReportedFrame> read_reported_frames(const std::string& folder, PoseSource poses);

}  // namespace edgevo
