#pragma once
// How a --realtime run keeps up with its source: measured while it runs, and told in summary.yaml,
// report.html and the closing line.
//
// Latency of a frame: from when it was due (a recording), came in (a live camera) or was fetched (no pace),
// until its pose was there.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo::app {

/// Takes the times of each frame down, in the order of the rows of the run. All in seconds of one clock.
class KeepingUp {
 public:
  /// `pace`: when frames are due, in words.
  explicit KeepingUp(const std::string& pace) { sums_.pace = pace; }
  /// A frame that a live camera gave and the odometry did not get.
  void note_dropped();
  /// A frame that was due at `due_s`, handed over at `handed_s`, and had its pose (or none) at `done_s`.
  void note_done(double due_s, double handed_s, double done_s);
  /// Into the frames and the sums of the run that the odometry returned.
  void write_to(Run* run) const;

 private:
  RealtimeRecord sums_;
  std::vector<std::optional<double>> latency_ms_;
  double begin_s_ = 0;
};

/// Milliseconds that half, 95 and 99 % of the frames do not exceed (nearest rank), and the largest.
struct LatencyFigures {
  double p50 = 0, p95 = 0, p99 = 0, max = 0;
};
/// None where no frame has a latency.
std::optional<LatencyFigures> latency_figures(const Run& run);

/// One sentence; empty for a synchronous run.
std::string latency_statement(const Run& run);

}  // namespace edgevo::app
