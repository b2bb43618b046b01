// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rotation that a gyro measured between two times, with its covariance and derivatives.
//
// Rates are joined by straight lines, and each piece turns at its mean rate. In the axes of the gyro a point
// turns by
//     R <- exp(-u dt) R,   u = (1 + s) (m - b)
// for the measured rate m, the bias b and the errors s of the three scales. Errors are delta in
// R <- exp(delta) R.
#include <Eigen/Geometry>
#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "edgevo/core/gyro_sample.h"

namespace edgevo {

/// Seconds for which a gyro that turns repeats its rates if it is stuck: a coarse one does for some samples.
constexpr double kStuckS = 1;

/// What is wrong with the rates of a gyro, the same for all samples.
struct GyroErrors {
  /// Rate that it shows at rest, rad/s.
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  /// True rate over shown rate, less 1, for each axis.
  Eigen::Vector3d scale = Eigen::Vector3d::Zero();
};

/// Whether the rates of one axis end at the limit of the sensor's range: counts those at the largest
/// magnitude so far and those just below.
class ClippedRates {
 public:
  /// Takes the next rate, as measured.
  void add(double rate);
  /// Whether they do.
  bool is_clipped() const;
  /// The largest magnitude so far, as measured.
  double limit() const { return limit_; }
  /// Share of all rates that are there, 0 to 1.
  double share() const { return rates_ > 0 ? double(at_limit_) / rates_ : 0; }

 private:
  double limit_ = 0;
  int rates_ = 0, at_limit_ = 0, below_ = 0;
};

/// Rotation between two times, in the axes of the gyro.
struct GyroRotation {
  /// p_end = R p_begin for a point that does not move.
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  /// Covariance of delta in R <- exp(delta) R by the noise of the samples, and by those that are missing.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// Derivatives of delta by bias and scale.
  Eigen::Matrix3d by_bias = Eigen::Matrix3d::Zero(), by_scale = Eigen::Matrix3d::Zero();
  /// Corrected rates at both ends, rad/s.
  Eigen::Vector3d rate_begin = Eigen::Vector3d::Zero(), rate_end = Eigen::Vector3d::Zero();
};

/// The newest samples of a gyro, and rotations from them. Times are in seconds of the gyro's clock, from that
/// of the first sample.
class GyroIntegrator {
 public:
  /// Takes the next sample; a spike before it is removed, as if it were missing. One that is not after the
  /// one before, is not finite, or turns as the one before it to the last bit, as a sensor does that is
  /// stuck, is not used; returns whether it was. At rest many repeat their rates.
  bool add(const GyroSample& sample);
  /// How many spikes were removed: samples that are off the line between both neighbours by more than noise
  /// explains, and than these are off one another. Of others that are off so far the rotation is as unsure as
  /// they are off.
  int spikes() const { return spikes_; }
  /// How many samples are missing, by the gaps between the times of the others.
  int missing() const { return missing_; }
  /// Their share of all, 0 to 1.
  double missing_share() const { return missing_ > 0 ? double(missing_) / (offered_ + missing_) : 0; }
  /// Whether these rates, as measured, are those of a gyro at rest.
  bool rests(const Eigen::Vector3d& rate) const;
  /// For how long the rates have been the same, seconds.
  double repeated_s() const { return repeated_s_; }
  /// The axis whose rates end at a limit of the sensor, if one has so far: where they pass through their
  /// largest values, they are there more often than just below.
  const ClippedRates* clipped() const;
  /// Multiplies all rates from now on: the unit, rad/s.
  void set_unit(double rad_per_unit);
  /// The unit of the rates as measured, rad/s.
  double unit() const { return unit_; }
  /// Seconds of a time from that of the first sample.
  double seconds(Timestamp time) const { return first_ ? seconds_between(*first_, time) : 0; }
  /// Whether a sample was taken.
  bool has_samples() const { return first_.has_value(); }
  /// Times of the newest and the oldest sample that is kept; 0 without one. Whether older ones were
  /// forgotten.
  double newest() const { return samples_.empty() ? 0 : samples_.back().t; }
  /// Time of the oldest sample that is kept; 0 without one.
  double oldest() const { return samples_.empty() ? 0 : samples_.front().t; }
  /// Whether older ones were forgotten.
  bool forgets() const { return oldest() > 0; }

  /// Rotation from `begin` to `end`, seconds; nothing where samples are missing for kMaxGapS, or are
  /// forgotten. Cost: 0.15 microseconds a sample.
  std::optional<GyroRotation> rotation(double begin, double end, const GyroErrors& errors) const;
  /// Mean of the rates as measured between two times, rad/s; nothing as rotation(). Cost: O(log samples).
  std::optional<Eigen::Vector3d> mean_rate(double begin, double end) const;
  /// Rate at a time, linear between samples; nothing as rotation().
  std::optional<Eigen::Vector3d> rate(double t, const GyroErrors& errors) const;

  /// Standard deviation of the white noise, rad/s over the root of a hertz: by how much three samples in a
  /// row are off a straight line, which motion adds to where samples are rare. 0: not known yet.
  double noise() const { return noise_; }
  /// Median time between two samples, seconds; 0: not known yet.
  double step() const { return step_; }

  /// Samples that are further apart do not say what was between them: a hand turns within that.
  static constexpr double kMaxGapS = 0.1;

 private:
  struct Sample {
    double t;                  // seconds
    Eigen::Vector3d rate;      // as measured
    Eigen::Vector3d integral;  // of the rates up to it, rad
    double unsure2 = 0;        // variance of its rate beyond that of the noise
  };
  using Iterator = std::deque<Sample>::const_iterator;

  // The first sample after `begin`; nothing unless samples without a gap reach over both times.
  std::optional<Iterator> first_within(double begin, double end) const;
  Eigen::Vector3d integral_to(double t) const;
  void count_missing(double t);
  void weigh_newest(double t, const Eigen::Vector3d& rate);
  void measure_noise();
  void forget();

  std::deque<Sample> samples_;
  std::array<ClippedRates, 3> axes_;
  std::deque<double> gaps_;  // times of samples that come after a gap
  std::optional<Timestamp> first_;
  double unit_ = 1, noise_ = 0, step_ = 0, repeated_s_ = 0, repeated_since_ = 0;
  double offered_until_ = 0;  // time of the newest sample, used or not
  int since_measured_ = 0, spikes_ = 0, offered_ = 0, missing_ = 0;
};

}  // namespace edgevo
