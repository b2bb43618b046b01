// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where the newest frame of a servo loop is in the map that was kept of an earlier run.
//
// Two measurements say it: the map of this run, once its keyframes were found in the kept one, and the image
// by itself (places/view_locator.h). A young map, or one made in changing light, may have been found and
// still be wrong in its unit, or bend from it slowly, so images are located until one agrees with it, again
// after a doubt, a loss or another placement, and now and then; it is not believed while the newest of them
// contradicts it.
//
// Distributed under the GPL when linked, as ViSP is (see LICENSE).
#include <memory>
#include <optional>

#include "edgevo/odometry/odometry.h"
#include "edgevo/places/view_locator.h"

namespace edgevo {

/// Pose of the newest frame in the kept map, as ServoFeed::publish() takes it.
struct KeptMapPose {
  /// Whether it is that of the map of this run, which was found there.
  bool is_by_own_map = false;
  /// If not: that of the image by itself, T_kept_cam in the unit of the kept map; nothing: not found.
  std::optional<SE3> by_image;
};

/// Decides between the two measurements. For one thread.
class KeptMapTracker {
 public:
  /// `kept` is not null and has the pinhole that the odometry works in.
  explicit KeptMapTracker(std::shared_ptr<const PlaceStore> kept) : locator_(std::move(kept)) {}

  /// Call after each frame. `is_found`: whether the frame's segment was found in the kept map. Cost: some 20
  /// to 40 ms at 640x480; while the map of this run is believed, at every eighth frame.
  KeptMapPose follow(const Odometry& odometry, bool is_found);

 private:
  ViewLocator locator_;
  std::shared_ptr<const FramePyramid> newest_image_;
  int segment_ = -1, world_changes_ = 0, unlooked_ = 0;
  bool agrees_ = false, contradicts_ = false;
};

}  // namespace edgevo
