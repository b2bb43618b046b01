// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The odometry as the sensor of the servo loop, with its latency.
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "edgevo/map/found_segments.h"
#include "edgevo/map/map_log.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/run_loop/past_follower.h"
#include "edgevo/servo/kept_goal.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"
#include "edgevo/visp_bridge/kept_map_pose.h"
#include "edgevo/visp_bridge/servo_feed.h"

namespace edgevo {

/// The odometry, whose results reach the feed after its latency. Places are recognised next to it, as if in a
/// thread of their own.
class DelayedSensor {
 public:
  /// `kept`: the map of an earlier loop; null: none.
  DelayedSensor(const Camera& camera, const OdometryParams& params, const ServoParams& servo, ServoFeed* feed,
                std::shared_ptr<const PlaceStore> kept);

  /// Adds an image at its time, in place of one that still waits.
  void push(Frame frame);

  /// Processes the waiting image if the odometry becomes free before `until_s`, and publishes results that
  /// are ready by then.
  void advance(double until_s, std::vector<ServoRow>* rows);

  /// Number of images that were replaced.
  int replaced() const { return replaced_; }
  /// Ends the odometry: its run and keyframes, without a goal. Call once.
  KeptLoop finish();

 private:
  PastParams past_params(std::shared_ptr<const PlaceStore> kept);
  void work(std::vector<ServoRow>* rows);

  // A result, and when it is ready.
  struct Result {
    double time_s;
    NewestPose pose;
    KeptMapPose kept;
  };
  const std::shared_ptr<MapLog> log_ = std::make_shared<MapLog>();
  std::vector<StoredKeyframe> keyframes_;
  MapCursor events_;
  FoundSegments found_;
  std::optional<KeptMapTracker> in_kept_;  // none without a kept map
  PastFollower past_;                      // made before the odometry
  Odometry odometry_;
  std::optional<double> given_latency_s_;
  bool cpu_latency_;
  ServoFeed* feed_;
  std::optional<Frame> waiting_;
  std::deque<Result> ready_;
  double free_at_s_ = 0;
  int replaced_ = 0;
};

}  // namespace edgevo
