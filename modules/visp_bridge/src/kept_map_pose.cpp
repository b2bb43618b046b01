// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/kept_map_pose.h"

#include <utility>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/tracking/frame_view.h"

namespace edgevo {
namespace {

// Shares of the median depth plus radians: three times what a located image is usually off.
constexpr double kAgrees = 0.015;
// Images of which one is located while the map is believed: some 5 ms for each.
constexpr int kImagesPerLook = 8;

}  // namespace

KeptMapPose KeptMapTracker::follow(const Odometry& odometry, bool is_found) {
  const NewestPose& newest = odometry.newest_pose();
  const std::shared_ptr<const FramePyramid> before =
      std::exchange(newest_image_, odometry.frame_view().pyramid);
  const bool is_another_map = std::exchange(segment_, newest.segment) != newest.segment;
  const bool is_placed_anew = std::exchange(world_changes_, newest.world_changes) != newest.world_changes;
  if (is_another_map || !newest.T_cam_map) contradicts_ = false;
  if (is_another_map || !newest.T_cam_map || is_placed_anew || newest.p_right < kDoubtfulBelow)
    agrees_ = false;
  const bool has_own = is_found && newest.T_cam_map;
  if (has_own && agrees_ && ++unlooked_ < kImagesPerLook) return {true, std::nullopt};
  unlooked_ = 0;
  std::optional<LocatedPose> image;
  if (newest_image_ && newest_image_ != before) image = locator_.locate(*newest_image_);
  if (has_own && image) {
    const SE3 T_kept_cam = newest.T_world_odom * T_odom_cam(newest, *newest.T_cam_map);
    agrees_ = view_difference(T_kept_cam, *image) < kAgrees;
    contradicts_ = !agrees_;
  }
  if (has_own && !contradicts_) return {true, std::nullopt};
  return {false, image ? std::optional(image->T_world_cam) : std::nullopt};
}

}  // namespace edgevo
