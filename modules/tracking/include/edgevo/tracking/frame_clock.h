// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How many frame intervals lie between two processed frames. The motion model predicts the next frame by
// counting frames. A source may skip frames (a camera does when its computer is busy), which shows in the
// timestamps. Timestamps are often times of arrival and jitter, so only whole multiples of the usual interval
// count, and a frame lasts at least half and at most one and a half of it.
#include <deque>
#include <optional>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Counts frame intervals from timestamps.
class FrameClock {
 public:
  /// Step from one processed frame to the next.
  struct Step {
    /// Number of frame intervals: 1 if no frame was skipped, at most kMaxFrames.
    int frames = 1;
    /// Duration in seconds; 0: not known.
    double seconds = 0;
  };

  /// Records a frame's timestamp and returns the step to it. Timestamps that do not increase, or by a tick
  /// only, carry no information: one frame, 0 s.
  Step tick(Timestamp time);

  /// Goes back to an earlier frame: the next one is the one after it.
  void set_back(Timestamp time) { newest_ = time; }

  /// Most skipped frames in a row: beyond them nothing can be predicted, and a sum of steps stays finite.
  static constexpr int kMaxFrames = 100;

 private:
  /// Recent intervals kept: even with a third of the frames missing, their lower quartile is one frame's.
  static constexpr size_t kIntervals = 15;
  /// Intervals needed before a usual one is known.
  static constexpr size_t kMinIntervals = 3;

  std::optional<Timestamp> newest_;
  std::deque<double> intervals_;  // the most recent ones, seconds
};

}  // namespace edgevo
