// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Observations that rawlog-grabber has taken from the sensor but not yet written.
//
// rawlog-grabber (MRPT 2.5.8) writes the older half of its buffer every GRABBER_PERIOD_MS, once more when it
// ends, and drops the rest: without this class, every recording would lose its last frames. An observation is
// held here until the grabber releases it, which it does after writing it; what remains is appended to the
// rawlog once that is closed (a rawlog is a gz stream, and gz streams may be concatenated). One thread.
#include <mrpt/obs/CObservation.h>

#include <deque>
#include <string>
#include <vector>

namespace edgevo {

class RecordingTail {
 public:
  /// Sets the rawlog: NAME.rawlog for `images_folder` NAME_Images, as rawlog-grabber passes it to the
  /// sensors.
  void record_next_to(const std::string& images_folder);
  void add(const mrpt::obs::CObservation::Ptr& observation) { held_.push_back(observation); }
  /// True if everything added has been written.
  bool all_written();
  /// Waits until the program has closed the rawlog (at most ten seconds), appends the missing observations
  /// and returns their number. Does nothing when there is no rawlog or nothing is held. Throws InputError.
  int append_the_rest();

 private:
  std::string rawlog_;
  std::deque<mrpt::obs::CObservation::Ptr> held_;
};

}  // namespace edgevo
