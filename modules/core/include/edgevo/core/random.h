#pragma once
// Seeds: one number a run; every part that draws derives its own stream from it, so that parts do not disturb each other.
#include <cstdint>

namespace edgevo {

/// SplitMix64: a tiny generator with a 64-bit state; the same numbers on every machine.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}  ///< any seed, 0 too
  /// A stream of its own for `purpose` (any constant) under the run's `seed`.
  static Random derive(uint64_t seed, uint64_t purpose) {
    Random r(seed);
    return Random(r.next() ^ (purpose * 0xD1B54A32D192ED03ull));
  }
  /// Uniform over all 64-bit numbers.
  uint64_t next() {
    uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1).
  double uniform() { return double(next() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }  ///< in [low, high)
  /// Uniform in 0..n-1, n > 0.
  int below(int n) { return int(next() % uint64_t(n)); }
  /// Standard normal (Box-Muller, one of the pair).
  double normal();

 private:
  uint64_t state_;
};

}  // namespace edgevo
