// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is found of a run's past while it goes on: the ground relates units of length, places that are seen
// again relate keyframes. For whoever feeds an Odometry frame by frame; run_odometry() does.
#include <functional>
#include <memory>
#include <optional>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/places/place_memory.h"
#include "edgevo/places/place_params.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// Parameters of what is found.
struct PastParams {
  /// How the ground is looked for (scale/ground_links.h).
  ScaleParams scale;
  /// Whether places are recognised (places/place_memory.h); not in runs that forget.
  PlaceParams places;
  /// A map that was kept, of the pinhole that the run works in, whose places are looked for, too; null: none.
  std::shared_ptr<const PlaceStore> kept;
  /// As PlaceMemory::look_up_young().
  bool looks_up_young = false;
  /// Is called as PlaceMemory::on_stored() says, in the thread that recognises places; empty: not.
  std::function<void(const StoredKeyframe&)> on_stored;
  /// The same as PlaceMemory::on_young().
  std::function<void(const StoredKeyframe&)> on_young;
  /// The same as PlaceMemory::on_found().
  std::function<void(const Constraint&)> on_found;
};

/// Follows the events of a run and adds constraints to them. Places are looked up in a thread of their own
/// where tracking and mapping have theirs.
class PastFollower {
 public:
  /// Make it before the Odometry. `options.map_log` is not null.
  PastFollower(const Camera& camera, const std::optional<SE3>& T_vehicle_cam, const OdometryOptions& options,
               const PastParams& params);
  ~PastFollower();

  /// Call after each frame.
  void follow();
  /// Call between Odometry::close() and finish(): waits until all places are looked up.
  PlaceCounts finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
