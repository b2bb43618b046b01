#pragma once
// What rawlog-grabber has taken from the sensor and not written yet.
//
// rawlog-grabber (MRPT 2.5.8) writes the older half of what it holds each GRABBER_PERIOD_MS, once more when
// it ends, and drops the rest: without this, each recording would lose its last frames. An observation is
// held here until the grabber has let go of it, which it does after writing it; what it leaves behind is
// appended to the rawlog once that is closed (a rawlog is a gz stream, and gz streams may follow each other).
// One thread.
#include <mrpt/obs/CObservation.h>

#include <deque>
#include <string>
#include <vector>

namespace edgevo {

class RecordingTail {
 public:
  /// `images_folder` as rawlog-grabber gives it to the sensors, NAME_Images: the rawlog is NAME.rawlog.
  void record_beside(const std::string& images_folder);
  void add(const mrpt::obs::CObservation::Ptr& observation) { held_.push_back(observation); }
  /// Everything that was added has been written.
  bool all_written();
  /// Waits until the program has closed the rawlog (at most ten seconds) and appends what is not in it.
  /// Returns how many. Throws InputError. Does nothing when there is no rawlog or nothing is held.
  int append_the_rest();

 private:
  std::string rawlog_;
  std::deque<mrpt::obs::CObservation::Ptr> held_;
};

}  // namespace edgevo
