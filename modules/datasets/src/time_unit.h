// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Times that a recorder wrote in milliseconds, microseconds or nanoseconds instead of seconds.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

struct TimeUnit {
  /// Name of the unit: "seconds", "milliseconds", ...
  const char* name;
  /// Symbol of the unit: "s", "ms", "us" or "ns".
  const char* symbol;
  /// Decimal exponent relative to a second: 0, 3, 6 or 9.
  int decimals;
};

/// Unit in which numbers may be largest.
constexpr TimeUnit kAnyUnit{"nanoseconds", "ns", 9};

/// The unit of some times, and why.
struct UnitOfTimes {
  TimeUnit unit{"seconds", "s", 0};
  /// What it rests on; empty for seconds without evidence.
  std::string reason;
  /// Why it is doubtful, and what to do (core/input_decision.h); empty: not doubtful.
  std::string doubt;
};

/// The unit of `times` (in their given order), by the median step between images (a video has no steps of
/// five seconds or more) and by the size of numbers that count from 1970. If the two contradict each other,
/// the date decides, unless the step then is that of a usual video; that is a doubt.
UnitOfTimes time_unit_of(const std::vector<double>& times);

/// A time of another unit than that before it.
struct OtherUnit {
  size_t index = 0;
  /// The larger of the two numbers over the smaller: 1e3, 1e6 or 1e9.
  double factor = 1;
};

/// The first of `times` (in their given order) in another unit than that before it; nullopt: none. Evidence
/// is a jump by 10^3, 10^6 or 10^9 that vanishes in the other unit, for the time after it as well.
std::optional<OtherUnit> other_unit_in(const std::vector<double>& times);

/// Parses a number of that unit, exact to the tick. False if `text` is not entirely a number, or is too
/// large.
[[nodiscard]] bool parse_time(const std::string& text, const TimeUnit& unit, Timestamp* t);

/// The unit of that symbol, as the user gave it. Throws InputError for another symbol.
UnitOfTimes time_unit_given(const std::string& symbol);

/// Parses times, all in the unit with the symbol `given`, or, if that is empty, in the unit that they appear
/// to be in. The unit is stored in `unit`. False: `bad` is the index of the first text that is not a number.
[[nodiscard]] bool parse_times(const std::vector<std::string>& texts, const std::string& given,
                               std::vector<Timestamp>* times, UnitOfTimes* unit, size_t* bad);

}  // namespace edgevo
