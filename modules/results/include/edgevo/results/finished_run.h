#pragma once
// What runs have left on disk, read back for comparison: those of `edgevo run` and the jobs of `edgevo
// bench`.
#include <string>
#include <vector>

#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// A folder with results, and what it tells. Where `problem` is not empty the rest is what could be read
/// before.
struct FinishedRun {
  std::string folder;  ///< where it lies
  std::string problem;       ///< in a line, why it cannot be compared: half written, spoilt
  std::string source;        ///< what was run: path of the source, or sequence of a benchmark
  std::string report;        ///< path of its own page; empty if there is none
  std::string ground_truth;  ///< path of a trajectory file; empty if none is known, or it is there no more
  int frames = 0;            ///< put in
  int lost = 0;              ///< of them, without a pose after the first that has one
  int keyframes = 0;  ///< that are frames of the run
  int segments = 0;  ///< with a pose
  double cpu_ms = 0;      ///< of the odometry, mean over the frames
  Trajectory trajectory;  ///< final poses; none where no frame has one
};

/// The folders at or below `path` that a run has begun to write (they hold a trajectory_tum.txt or a
/// frames.csv), in the order of their names. Nothing is looked for within a run. Throws InputError: `path` is
/// no folder, or none is there.
std::vector<std::string> find_runs(const std::string& path);

/// Never throws for what is wrong with the folder: `problem` says it. Cost: linear in the frames.
FinishedRun read_finished_run(const std::string& folder);

}  // namespace edgevo
