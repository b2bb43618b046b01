#pragma once
// The odometry as the sensor of the servo loop, and how long its results are under way.
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "edgevo/odometry/odometry.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"
#include "edgevo/visp_bridge/servo_feed.h"

namespace edgevo {

class DelayedSensor {
 public:
  DelayedSensor(const Camera& camera, const OdometryParams& params, const ServoParams& servo,
                ServoFeed* feed);

  /// An image at its time; one that still waits is replaced.
  void push(Frame frame);

  /// Works on the waiting image if the odometry comes free before `until_s`; hands results out that are ready
  /// by then.
  void advance(double until_s, std::vector<ServoRow>* rows);

  int replaced() const { return replaced_; }

 private:
  void work(std::vector<ServoRow>* rows);

  Odometry odometry_;
  std::optional<double> given_latency_s_;
  bool cpu_latency_;
  ServoFeed* feed_;
  std::optional<Frame> waiting_;
  std::deque<std::pair<double, NewestPose>> ready_;  // when, and what
  double free_at_s_ = 0;
  int replaced_ = 0;
};

}  // namespace edgevo
