// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Follows the unknowns of a gyro by rotations of the images, and separates an error that changed at once
// from a single image that is wrong. What no rival explains is a gyro that does not turn with the camera.
//
// A Kalman filter takes each rotation as either within its covariance, or as an outlier, ten times as wide or
// anywhere: the probability of the first is the weight of its update. Next to it rivals are kept, two for
// each thing that may change at once: in each the covariance of that thing was opened once, a short or a
// longer time ago, and its odds are those of a change times the ratio of the likelihoods since. Once one is
// sure, it takes the place of the filter. Until then, what is given is the mean of all, with the covariance
// of the mixture (Blom and Bar-Shalom, IEEE Trans. Automatic Control 33, 1988).
#include <optional>
#include <vector>

#include "edgevo/gyro/gyro_calibration.h"

namespace edgevo {

/// What may change at once.
enum class GyroChangeKind { kBias, kScale, kClock, kMount, kAll };

/// A change that was found.
struct FoundGyroChange {
  /// What has changed.
  GyroChangeKind kind = GyroChangeKind::kBias;
  /// From which rotation on, seconds in GyroIntegrator's count.
  double since_s = 0;
  /// By how much, by now.
  GyroChange by = GyroChange::Zero();
};

/// The filter and its rivals. One thread at a time.
class GyroFilter {
 public:
  /// Begins with `model`.
  explicit GyroFilter(const GyroModel& model) : nominal_(model), mean_(model) {}
  /// Takes a rotation that the images show, whose covariance and that of the gyro's noise are `factor` times
  /// larger than stated. Returns what has changed, if that is sure now. Cost: 60 microseconds.
  std::optional<FoundGyroChange> see(const GyroIntegrator& gyro, const SeenTurn& seen, double factor);
  /// Whether the newest rotations are more likely if the gyro turns with something else, or not at all.
  bool is_broken() const { return broken_ > 0.5; }
  /// Variance of its rates because it may be, (rad/s)^2.
  double variance_of_rate() const;
  /// Whether that was so after a time, seconds in GyroIntegrator's count: what it shows since then is not
  /// that of the camera.
  bool was_broken_after(double t) const { return is_broken() || t < broken_until_s_; }
  /// The unknowns with the covariance of the mixture.
  const GyroModel& model() const { return mean_; }

 private:
  // What the unknowns are if something has changed.
  struct Rival {
    GyroChangeKind kind;
    GyroModel model, before;
    double life_s, since_s, log_odds, first_log_odds;
  };
  void begin_rivals(const SeenTurn& seen);
  const Rival* sure_rival() const;
  double log_odds_of_all() const;
  void weigh_broken(double dt, double log_ratio);
  void mix();

  GyroModel nominal_, mean_;
  std::vector<Rival> rivals_;
  double broken_until_s_ = -1e9;
  double broken_ = 0;  // probability that it does not turn with the camera now
};

/// In words: "its bias has changed by ... ".
std::string describe(const FoundGyroChange& change);

}  // namespace edgevo
