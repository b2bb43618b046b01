// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Looks for the keyframes of a servo loop in a map that was kept.
#include <memory>

#include "edgevo/core/worker.h"
#include "edgevo/map/found_segments.h"
#include "edgevo/map/map_log.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/places/place_memory.h"
#include "edgevo/visp_bridge/kept_map_pose.h"

namespace edgevo {

/// Keyframes are looked up all along, while they are in the window: the pose at the goal rests on what the
/// camera sees there. In a thread of its own where tracking and mapping have theirs.
class KeptMapSearch {
 public:
  /// Make it before the Odometry. `options.map_log` and `kept` are not null; `kept` has the pinhole that the
  /// odometry works in.
  KeptMapSearch(const Camera& camera, const OdometryOptions& options, std::shared_ptr<const PlaceStore> kept);

  /// Call after each frame.
  void follow();
  /// Where the newest frame is in the kept map.
  KeptMapPose pose(const Odometry& odometry) {
    return tracker_.follow(odometry, found_.contains(odometry.newest_pose().segment));
  }

 private:
  KeptMapTracker tracker_;
  PlaceMemory places_;
  MapCursor events_;
  FoundSegments found_;
  Worker worker_;  // the last one: its work uses the others
};

}  // namespace edgevo
