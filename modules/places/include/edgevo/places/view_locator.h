// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Locates single images in a map that was kept: a run that has no map of its own yet, or a camera that turns
// or stands, from whose images none can be made.
//
// An image is located by the places that look alike, each by corners and edges (locate_view()). Its pose is
// believed if no other place explains it as well, and if those of two images shortly before it are next to
// it.
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "edgevo/map/located_pose.h"
#include "edgevo/places/place_index.h"
#include "edgevo/places/place_match.h"
#include "edgevo/places/place_store.h"

namespace edgevo {

/// Finds images of one camera in a kept map. For one thread.
class ViewLocator {
 public:
  /// `map`, not null, of the pinhole that the images are rectified to, all of one unit.
  explicit ViewLocator(std::shared_ptr<const PlaceStore> map);

  /// The pose of the next image; nothing if it is not believed. Cost: some 20 ms at 640x480.
  std::optional<LocatedPose> locate(const FramePyramid& pyramid);

 private:
  std::optional<LocatedPose> by_image(const RememberedView& view);

  std::shared_ptr<const PlaceStore> map_;
  PlaceIndex index_;
  std::vector<size_t> keyframe_of_;  // by number of the view in the index
  PlaceVotes votes_;
  std::deque<std::optional<LocatedPose>> recent_;  // of the last images, the newest last
};

/// By how much the view of a pose differs from that of one that was located: shares of the median depth plus
/// radians.
double view_difference(const SE3& T_world_cam, const LocatedPose& located);

/// ViewLocator::locate() as a function that owns its locator: what OdometryOptions::locate takes. Empty
/// without a map.
std::function<std::optional<LocatedPose>(const FramePyramid&)> locate_in(
    std::shared_ptr<const PlaceStore> map);

}  // namespace edgevo
