// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The samples of a source's gyro for whoever feeds an Odometry frame by frame; run_odometry() does.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/gyro/gyro_model.h"
#include "edgevo/odometry/odometry.h"

namespace edgevo {

/// Reads a gyro up to each frame.
class GyroFeed {
 public:
  /// `readings`: ImageSource::gyro_readings(); may be empty.
  explicit GyroFeed(GyroReadings readings = {}) : readings_(std::move(readings)) { advance(); }

  /// Passes on the samples up to the time of the next frame, and as much after it as clocks may differ.
  void feed_until(Timestamp time, Odometry* odometry) {
    constexpr double kAfterS = kMostGyroOffsetS + 0.1;  // and a sample of a slow one
    if (!first_frame_) first_frame_ = time;
    last_frame_ = time;
    for (; next_ && seconds_between(time, next_->time) < kAfterS; advance()) {
      odometry->add_gyro(*next_);
      if (accelerations_.size() < kMostAccelerations && !next_->acceleration.isZero())
        accelerations_.push_back(*next_);
    }
  }

  /// The first samples that have an acceleration, of some minutes: they show where up is
  /// (scale/up_by_gravity.h).
  std::vector<GyroSample> take_accelerations() { return std::move(accelerations_); }

  /// What is to be said if its samples are not of the time of the frames; else empty. A foreign clock, or
  /// that of another recording.
  std::string mismatch() const;

 private:
  static constexpr size_t kMostAccelerations = 100'000;  // 6 MB
  void advance() {
    if (next_) newest_ = next_->time;
    next_ = readings_ ? readings_() : std::nullopt;
    if (next_ && !first_) first_ = next_->time;
  }

  GyroReadings readings_;
  std::optional<GyroSample> next_;
  std::optional<Timestamp> first_, newest_;  // of all samples, and of those that were passed on
  std::optional<Timestamp> first_frame_, last_frame_;
  std::vector<GyroSample> accelerations_;
};

}  // namespace edgevo
