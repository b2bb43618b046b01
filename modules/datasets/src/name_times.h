// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Times in the names of images. Read are, after a beginning that all names share:
//
//   1305031102.175304           seconds
//   1403636579763555584         a count since 1970 in seconds, milliseconds, microseconds or nanoseconds,
//                               recognised by a date between 2001 and 2036
//   frame_00_01_27.000          a clock, also with a date (name_clock.h)
//
// All other numbers count.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/input_decision.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Times of images by their names.
struct NameTimes {
  std::vector<Timestamp> times;
  InputDecision decision;
  /// After which time the clock may show the same again, s: a day without a date, an hour (the end of summer
  /// time) with one; 0: never.
  double period_s = 0;
};

/// Times of images from their names without suffix, in the order of the names; nullopt if the names hold no
/// times. `unit`: symbol of the unit of numbers without a decimal point (time_unit.h); empty: by their date.
/// Throws InputError for an unknown symbol.
std::optional<NameTimes> times_of_names(const std::vector<std::string>& stems, const std::string& unit);

/// The numbers at the end of names without suffix, if what comes before is the same in all; else none.
std::vector<std::string> last_numbers(const std::vector<std::string>& stems);

}  // namespace edgevo
