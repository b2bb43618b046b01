// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several runs on one page: a sortable table, the worst run first, a picture of each path, and overlaid paths
// of runs with the same ground truth. One file that needs nothing but a browser.
#include <string>
#include <vector>

#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// A run in the comparison.
struct ComparedRun {
  /// Name of the run, unique on the page.
  std::string name;
  /// Reason why the run cannot be compared (only the name is used then); empty: it can.
  std::string problem;
  /// Input of the run: path of the source, or sequence of a benchmark.
  std::string source;
  /// The run's own report as a URL relative to this page; empty: none.
  std::string link;
  /// Path of the true trajectory; empty: unknown. If it cannot be read or compared, the row says so.
  std::string ground_truth;
  /// Counts of frames, of frames without a pose after the first with one, of keyframes and of segments.
  int frames = 0, lost = 0, keyframes = 0, segments = 0;
  /// CPU time of the odometry, milliseconds a frame.
  double cpu_ms = 0;
  /// Final poses, T_world_cam; frames.csv is found next to Trajectory::path (find_input_frames).
  Trajectory trajectory;
};

/// By this a page is recognised, in its first line.
constexpr const char* kComparePageMark = "<title>edgevo compare</title>";

/// The page for one run or hundreds of them. Size: 2 kB a run, and 5 kB for each of the first 40 with the
/// same ground truth. The error figures are those of `edgevo eval`. Cost: one evaluate() a run.
std::string compare_html(const std::vector<ComparedRun>& runs);

}  // namespace edgevo
