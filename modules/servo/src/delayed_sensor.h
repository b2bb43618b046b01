// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The odometry as the sensor of the servo loop, with its latency.
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "edgevo/odometry/odometry.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"
#include "edgevo/visp_bridge/servo_feed.h"

namespace edgevo {

/// The odometry, whose results reach the feed after its latency.
class DelayedSensor {
 public:
  DelayedSensor(const Camera& camera, const OdometryParams& params, const ServoParams& servo,
                ServoFeed* feed);

  /// Adds an image at its time, in place of one that still waits.
  void push(Frame frame);

  /// Processes the waiting image if the odometry becomes free before `until_s`, and publishes results that
  /// are ready by then.
  void advance(double until_s, std::vector<ServoRow>* rows);

  /// Number of images that were replaced.
  int replaced() const { return replaced_; }

 private:
  void work(std::vector<ServoRow>* rows);

  Odometry odometry_;
  std::optional<double> given_latency_s_;
  bool cpu_latency_;
  ServoFeed* feed_;
  std::optional<Frame> waiting_;
  /// Results, with the times at which they are ready.
  std::deque<std::pair<double, NewestPose>> ready_;
  double free_at_s_ = 0;
  int replaced_ = 0;
};

}  // namespace edgevo
