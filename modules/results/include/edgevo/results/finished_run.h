// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Results on disk, read back for comparison: runs of `edgevo run` and jobs of `edgevo bench`.
#include <string>
#include <vector>

#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// Results read from the folder of a run. If `problem` is not empty, the other fields hold what could be read
/// before it was met.
struct FinishedRun {
  /// Folder of the run.
  std::string folder;
  /// Reason, in one line, why the run cannot be compared (incomplete, corrupt); empty: it can.
  std::string problem;
  /// Input of the run: path of the source, or sequence of a benchmark.
  std::string source;
  /// Path of the run's report.html; empty if there is none.
  std::string report;
  /// Path of a trajectory file; empty if none is known or it no longer exists.
  std::string ground_truth;
  /// Number of frames processed.
  int frames = 0;
  /// Number of frames without a pose after the first frame with one.
  int lost = 0;
  /// Number of keyframes that belong to a frame of the run.
  int keyframes = 0;
  /// Number of trajectory segments with a pose.
  int segments = 0;
  /// CPU time of the odometry, milliseconds, mean over the frames.
  double cpu_ms = 0;
  /// Final poses; empty if no frame has one.
  Trajectory trajectory;
};

/// Folders of runs at or below `path`, sorted by name: those that hold a trajectory_tum.txt or a frames.csv.
/// Folders within a run are not searched. Throws InputError: `path` is not a folder, or holds no run.
std::vector<std::string> find_runs(const std::string& path);

/// Reads the results in `folder`. Errors do not throw: they are described in FinishedRun::problem. Cost:
/// linear in the frames.
FinishedRun read_finished_run(const std::string& folder);

}  // namespace edgevo
