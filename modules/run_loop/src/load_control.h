// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a run skips where the machine is too slow for the schedule of its frames: a pose that comes late
// is worth less than a coarser map.
#include "edgevo/mapping/shedding.h"

namespace edgevo {

/// Decides from how late each frame is when the odometry takes it. Sheds more after three such frames in a
/// row, or at once after one that is very late, and less again after two seconds in time at 30 frames/s.
/// Pure.
class LoadControl {
 public:
  /// Takes the next frame, which comes `late_s` seconds after it was due. Returns what is to be shed.
  Shedding next(double late_s);
  /// Whether a frame is to be dropped: its pose would come too late, and keep the next ones waiting.
  static bool drops(double late_s) { return late_s > kTooLateS; }

  /// Seconds.
  static constexpr double kTooLateS = 0.08;

 private:
  void shed(int steps);

  Shedding shedding_ = Shedding::kNothing;
  int late_ = 0, in_time_ = 0;  // frames in a row
};

}  // namespace edgevo
