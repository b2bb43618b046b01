// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Statistics of a run from its records: for the closing line, frames.csv, summary.yaml, report.html and
// tables.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Counts of the contents of a run.
struct RunCounts {
  /// Number of input frames.
  int frames = 0;
  /// Number of frames with a final pose.
  int with_pose = 0;
  /// Number of frames in state LOST.
  int lost = 0;
  /// Number of doubtful frames (core/doubtful_frame.h), LOST ones included.
  int doubtful = 0;
  /// Number of frames that are not doubtful by themselves, but whose place is a guess (guessed_places.h).
  int guessed = 0;
  /// Number of doubtful keyframes (KeyframeRecord::is_doubtful).
  int doubtful_keyframes = 0;
  /// Number of connected segments of trajectory.
  int segments = 0;
  /// Number of keyframes of all segments.
  int keyframes = 0;
  /// Number of edge points of all keyframes.
  size_t points = 0;
  /// Number of edge lines of all keyframes.
  size_t lines = 0;

  /// Whether fewer than half of the frames have a pose.
  bool mostly_failed() const { return 2 * with_pose < frames; }
  /// Number of poses that are doubtful: a LOST frame claims none.
  int doubtful_poses() const { return doubtful - lost; }
  /// Whether more than a quarter of the poses are doubtful. At most 2 % of right ones are, and a run that is
  /// right has never had more than a fifth (lab 2026-11-26_trust).
  bool is_largely_doubtful() const { return 4 * doubtful_poses() > with_pose; }
  /// Whether more than a quarter of the poses are doubtful or in a place that is a guess.
  bool is_largely_untrusted() const { return 4 * (doubtful_poses() + guessed) > with_pose; }
};
/// Counts the contents of a run.
RunCounts count(const Run& run);

/// Names of the stages in the order in which they first ran.
std::vector<std::string> stages_of(const Run& run);
/// For each stage, its CPU time in the frames in which it ran, milliseconds.
std::vector<std::pair<std::string, std::vector<double>>> stage_times(const Run& run);
/// For each frame, the total CPU time of its stages, milliseconds.
std::vector<double> total_ms(const Run& run);
/// Smallest value that `share` (0 to 1) of the sorted values do not exceed (nearest rank). `sorted` must not
/// be empty.
double percentile(const std::vector<double>& sorted, double share);

// How a --realtime run kept up with its source. Latency of a frame: FrameRecord::latency_ms.

/// Percentiles of the latency (nearest rank) and its maximum.
struct LatencyFigures {
  /// Milliseconds.
  double p50 = 0, p95 = 0, p99 = 0, max = 0;
};
/// Percentiles of `ms`; nullopt for no values.
std::optional<LatencyFigures> latency_figures(std::vector<double> ms);
/// Percentiles over the frames of `run`; nullopt if no frame has a latency.
std::optional<LatencyFigures> latency_figures(const Run& run);

/// Latency in one sentence; empty for a synchronous run.
std::string latency_statement(const Run& run);

}  // namespace edgevo
