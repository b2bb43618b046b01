// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Looks for the keyframes of a servo loop in a map that was kept.
#include <memory>
#include <optional>

#include "edgevo/core/worker.h"
#include "edgevo/map/found_segments.h"
#include "edgevo/map/map_log.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/places/place_memory.h"

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
  /// Whether this segment was found.
  bool has_found(int segment) const { return found_.contains(segment); }

 private:
  PlaceMemory places_;
  MapCursor events_;
  FoundSegments found_;
  Worker worker_;  // the last one: its work uses the others
};

}  // namespace edgevo
