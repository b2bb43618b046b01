// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Times that a recorder wrote in milliseconds, microseconds or nanoseconds instead of seconds.
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

struct TimeUnit {
  /// Name of the unit: "seconds", "milliseconds", ...
  const char* name;
  /// Decimal exponent relative to a second: 0, 3, 6 or 9.
  int decimals;
};

/// Unit in which numbers may be largest.
constexpr TimeUnit kAnyUnit{"nanoseconds", 9};

/// The unit of `times` (in their given order): by the median step between images (a video has no steps of
/// five seconds or more) and by the size of numbers that count from 1970, the finer of both.
TimeUnit time_unit_of(const std::vector<double>& times);

/// Parses a number of that unit, exact to the tick. False if `text` is not entirely a number, or is too
/// large.
[[nodiscard]] bool parse_time(const std::string& text, const TimeUnit& unit, Timestamp* t);

/// Parses times, all in the unit that they appear to be in, which is stored in `unit`. False: `bad` is the
/// index of the first that is not a number.
[[nodiscard]] bool parse_times(const std::vector<std::string>& texts, std::vector<Timestamp>* times,
                               TimeUnit* unit, size_t* bad);

}  // namespace edgevo
