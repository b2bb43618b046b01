// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// When the images of a recording are due, so that a program receives them as from a camera.
#include <string>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Rule that determines when images are due.
struct Pace {
  /// Kind of rule.
  enum class Kind {
    /// Each image as soon as it is requested.
    kAtOnce,
    /// `value` images per second, whatever their times.
    kRate,
    /// By the times of the images, `value` times as fast.
    kTimes,
  };
  /// Kind of this rule.
  Kind kind = Kind::kAtOnce;
  /// Rate (kRate, images per second) or speed-up factor (kTimes), > 0.
  double value = 0;

  /// Time at which the n-th image played (from 0) is due, in seconds after the first image, whose time is
  /// `first`. Not for kAtOnce.
  double due_s(int n, Timestamp first, Timestamp time) const;
};

/// Parses "30": images per second; "1x": by the times of the source; "0.5x": at half speed. Throws
/// InputError.
Pace parse_pace(const std::string& text);

/// Text such as "30 frames a second" or "the source's own times".
std::string describe(const Pace& pace);

}  // namespace edgevo
