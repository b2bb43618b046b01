#pragma once
// Times that a recorder wrote in milliseconds, microseconds or nanoseconds where seconds are usual.
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

struct TimeUnit {
  const char* name;  ///< "seconds", "milliseconds", ...
  int decimals;      ///< of a second: 0, 3, 6, 9
};

/// The unit in which numbers may be largest.
constexpr TimeUnit kAnyUnit{"nanoseconds", 9};

/// By the usual step from image to image (steps of five seconds and more are no video's) and by the size of
/// numbers that count from 1970: the finer of both. Times are taken as they stand, in order.
TimeUnit time_unit_of(const std::vector<double>& times);

/// A number of that unit, exactly to the tick. False if `text` is not wholly a number, or too large.
[[nodiscard]] bool parse_time(const std::string& text, const TimeUnit& unit, Timestamp* t);

/// Texts of times, all in the unit that they seem to be in, which goes to `unit`. False: `bad` is the first
/// that is none.
[[nodiscard]] bool parse_times(const std::vector<std::string>& texts, std::vector<Timestamp>* times,
                               TimeUnit* unit, size_t* bad);

}  // namespace edgevo
