#pragma once
// How a --realtime run keeps up with its source, measured while it runs.
//
// Latency of a frame: from when it was due (a recording), came in (a live camera) or was fetched (no pace),
// until its pose was there.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Takes the times of each frame down, in the order of the rows of the run. All in seconds of one clock.
class KeepingUp {
 public:
  /// `pace`: when frames are due, in words.
  explicit KeepingUp(const std::string& pace) { sums_.pace = pace; }
  /// A frame that a live camera gave and the odometry did not get.
  void note_dropped();
  /// A frame whose image could not be used.
  void note_left_out() { latency_ms_.emplace_back(); }
  /// A frame that was due at `due_s`, handed over at `handed_s`, and had its pose (or none) at `done_s`.
  void note_done(double due_s, double handed_s, double done_s);
  /// Into the frames and the sums of the run that the odometry returned.
  void write_to(Run* run) const;

 private:
  RealtimeRecord sums_;
  std::vector<std::optional<double>> latency_ms_;
  double begin_s_ = 0;
};

}  // namespace edgevo
