// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random numbers. A run has one seed; each component derives its own stream from it, so that components do
// not affect each other.
#include <cstdint>

namespace edgevo {

/// SplitMix64: a small generator with a 64-bit state; same numbers on every machine.
class Random {
 public:
  /// Starts the stream of `seed`; any value is valid, including 0.
  explicit Random(uint64_t seed) : state_(seed) {}
  /// Independent stream for `purpose` (any constant) under the run's `seed`.
  static Random derive(uint64_t seed, uint64_t purpose) {
    Random r(seed);
    return Random(r.next() ^ (purpose * 0xD1B54A32D192ED03ull));
  }
  /// Next number, uniform over all 64-bit numbers.
  uint64_t next() {
    uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  /// Next number, uniform in [0, 1).
  double uniform() { return double(next() >> 11) * 0x1.0p-53; }
  /// Next number, uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Next integer, uniform in 0..n-1, n > 0.
  int below(int n) { return int(next() % uint64_t(n)); }
  /// Next number of the standard normal distribution (Box-Muller, one of the pair).
  double normal();

 private:
  uint64_t state_;
};

}  // namespace edgevo
