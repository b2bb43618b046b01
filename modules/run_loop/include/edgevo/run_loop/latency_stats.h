// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Latency and throughput of a --realtime run, measured while it runs.
//
// The latency of a frame counts from when it was due (recording), arrived (live camera) or was fetched (no
// pace) until its pose was available.
#include <deque>
#include <optional>
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// Collects the times of each frame, in the order of the rows of the run. All times in seconds of one clock.
class LatencyStats {
 public:
  /// `pace`: when frames are due, in words (RealtimeRecord::pace).
  explicit LatencyStats(const std::string& pace) { sums_.pace = pace; }
  /// Counts a frame that a live camera delivered but the odometry was too busy to take.
  void note_dropped();
  /// Counts a frame whose image was unusable.
  void note_skipped() { add(std::nullopt); }
  /// Counts a frame that was due at `due_s`, delivered at `delivered_s` and processed, with or without a
  /// pose, at `done_s`.
  void note_done(double due_s, double delivered_s, double done_s);
  /// Keeps the latencies of the newest `frames` only (OdometryOptions::forget).
  void forget_all_but(size_t frames) { most_ = frames; }
  /// Writes the latencies and totals into the frames and the realtime record of `run`.
  void write_to(Run* run) const;

 private:
  RealtimeRecord sums_;
  void add(std::optional<double> latency_ms);

  size_t most_ = 0;  // 0: all
  std::deque<std::optional<double>> latency_ms_;
  double begin_s_ = 0;
};

}  // namespace edgevo
