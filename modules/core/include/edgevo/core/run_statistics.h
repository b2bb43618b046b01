#pragma once
// Facts about a run that are counted in its records: for the closing line, frames.csv, summary.yaml,
// report.html and tables.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// How much a run holds of what.
struct RunCounts {
  int frames = 0;     ///< input frames
  int with_pose = 0;  ///< frames that have a final pose
  int lost = 0;       ///< frames in state LOST
  int segments = 0;   ///< connected stretches of trajectory
  int keyframes = 0;  ///< of all segments
  size_t points = 0;  ///< edge points of all keyframes
  size_t lines = 0;   ///< edge lines of all keyframes

  /// Fewer than half of the frames have a pose.
  bool mostly_failed() const { return 2 * with_pose < frames; }
};
RunCounts count(const Run& run);

/// Names of the stages in the order in which they first ran.
std::vector<std::string> stages_of(const Run& run);
/// For each of them the milliseconds of the frames in which it ran.
std::vector<std::pair<std::string, std::vector<double>>> stage_times(const Run& run);
/// For each frame the sum of its stages, milliseconds.
std::vector<double> total_ms(const Run& run);
/// Smallest value that `share` of the sorted values do not exceed (nearest rank). `sorted` is not empty.
double percentile(const std::vector<double>& sorted, double share);

// How a --realtime run kept up with its source. Latency of a frame: FrameRecord::latency_ms.

/// Milliseconds that half, 95 and 99 % of the frames do not exceed (nearest rank), and the largest.
struct LatencyFigures {
  double p50 = 0, p95 = 0, p99 = 0, max = 0;  ///< milliseconds
};
/// None of no values.
std::optional<LatencyFigures> latency_figures(std::vector<double> ms);
/// None where no frame has a latency.
std::optional<LatencyFigures> latency_figures(const Run& run);

/// One sentence; empty for a synchronous run.
std::string latency_statement(const Run& run);

}  // namespace edgevo
