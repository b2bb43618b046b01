#pragma once
// How far a source goes on from frame to frame. Motion is counted in frames: that of the next one is foreseen
// from it. A source may leave frames out (a camera does when its computer is busy), which the time tells; but
// times are often those of arrival and jitter, so only whole intervals count, of the usual one, and no frame
// is taken to last less than half of it or more than half as long again.
#include <deque>
#include <optional>

#include "edgevo/core/timestamp.h"

namespace edgevo {

class FrameClock {
 public:
  struct Step {
    int frames = 1;      ///< 1: none was left out; at most kMostFrames
    double seconds = 0;  ///< that they took; 0: not known
  };

  /// The frame of this time came. Times that do not grow tell nothing: one frame, 0 s.
  Step tick(Timestamp time);

  static constexpr int kMostFrames =
      100;  // left out in a row: further on nothing can be foreseen, and a sum of steps stays finite

 private:
  static constexpr size_t kIntervals =
      15;  // of late: where a third of the frames is missing, their lower quartile is still one frame's
  static constexpr size_t kFewIntervals = 3;  // with fewer no interval is the usual one

  std::optional<Timestamp> newest_;
  std::deque<double> intervals_;  // the latest, seconds
};

}  // namespace edgevo
