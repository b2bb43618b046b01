#pragma once
// When the images of a recording are due, so that a program meets them as it would meet those of a camera.
#include <string>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// A rule for when images are due.
struct Pace {
  /// The rule.
  enum class Kind {
    kAtOnce,  ///< each as soon as it is asked for
    kRate,    ///< `value` images a second, whatever their times say
    kTimes,   ///< as their times say, `value` times as fast
  };
  Kind kind = Kind::kAtOnce;  ///< the rule
  double value = 0;  ///< of kRate and kTimes, > 0

  /// Seconds after the first image (taken at `first`) at which the n-th (from 0, of those that are taken) is
  /// due. Not for kAtOnce.
  double due_s(int n, Timestamp first, Timestamp time) const;
};

/// "30": so many images a second; "1x": as their times say; "0.5x": half as fast. Throws InputError.
Pace parse_pace(const std::string& text);

/// "30 frames a second", "the source's own times", ...
std::string describe(const Pace& pace);

}  // namespace edgevo
