#pragma once
// Time as an integer count of 100 ns ticks since the Unix epoch: MRPT's resolution, so that a time survives a rawlog
// unchanged, and exact where a double epoch is not.
#include <cstdint>
#include <string>
#include <string_view>

namespace edgevo {

/// A moment, exact to 100 ns.
struct Timestamp {
  int64_t ticks = 0;  ///< 100 ns each

  static constexpr int64_t kTicksPerSecond = 10'000'000;  ///< MRPT's clock
  /// since the epoch, rounded to a double
  double seconds() const { return double(ticks) / double(kTicksPerSecond); }
  /// Rounds to the nearest tick.
  static Timestamp from_seconds(double s);
  static Timestamp from_nanoseconds(int64_t ns);  ///< rounded to the nearest tick

  friend bool operator==(Timestamp a, Timestamp b) { return a.ticks == b.ticks; }  ///< the same tick
  friend bool operator!=(Timestamp a, Timestamp b) { return a.ticks != b.ticks; }  ///< another tick
  friend bool operator<(Timestamp a, Timestamp b) { return a.ticks < b.ticks; }  ///< earlier
  friend bool operator<=(Timestamp a, Timestamp b) { return a.ticks <= b.ticks; }  ///< not later
};

/// Seconds from a to b.
inline double seconds_between(Timestamp a, Timestamp b) {
  return double(b.ticks - a.ticks) / double(Timestamp::kTicksPerSecond);
}

/// Seconds with seven decimals ("1305031102.1753040"): exact, and what every file of ours holds.
std::string to_string(Timestamp t);

/// Reads decimal seconds ("12.5", "1.036224e-01") exactly to the tick. Returns false if `text` is not wholly a number.
[[nodiscard]] bool parse_seconds(std::string_view text, Timestamp* t);

}  // namespace edgevo
