// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Time as an integer number of 100 ns ticks since the Unix epoch: the resolution of MRPT, so that times
// survive a rawlog unchanged; exact where seconds in a double are not.
#include <cstdint>
#include <string>
#include <string_view>

namespace edgevo {

/// A point in time, exact to 100 ns.
struct Timestamp {
  /// Number of ticks of 100 ns since the Unix epoch.
  int64_t ticks = 0;

  /// Resolution of MRPT's clock.
  static constexpr int64_t kTicksPerSecond = 10'000'000;
  /// Seconds since the epoch, rounded to a double.
  double seconds() const { return double(ticks) / double(kTicksPerSecond); }
  /// From seconds, rounded to the nearest tick.
  static Timestamp from_seconds(double s);
  /// From nanoseconds, rounded to the nearest tick.
  static Timestamp from_nanoseconds(int64_t ns);

  /// Whether a and b are the same tick.
  friend bool operator==(Timestamp a, Timestamp b) { return a.ticks == b.ticks; }
  /// Whether a and b are different ticks.
  friend bool operator!=(Timestamp a, Timestamp b) { return a.ticks != b.ticks; }
  /// Whether a is before b.
  friend bool operator<(Timestamp a, Timestamp b) { return a.ticks < b.ticks; }
  /// Whether a is not after b.
  friend bool operator<=(Timestamp a, Timestamp b) { return a.ticks <= b.ticks; }
};

/// Seconds from a to b.
inline double seconds_between(Timestamp a, Timestamp b) {
  return double(b.ticks - a.ticks) / double(Timestamp::kTicksPerSecond);
}

/// Seconds with seven decimals ("1305031102.1753040"): exact, the format of all files of edgevo.
std::string to_string(Timestamp t);

/// Reads decimal seconds ("12.5", "1.036224e-01") exactly to the tick. Returns false if `text` is not wholly
/// a number.
[[nodiscard]] bool parse_seconds(std::string_view text, Timestamp* t);

}  // namespace edgevo
