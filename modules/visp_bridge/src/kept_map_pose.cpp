// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/kept_map_pose.h"

#include <utility>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/tracking/frame_view.h"

namespace edgevo {

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
  if (has_own && agrees_) return {true, std::nullopt};
  std::optional<LocatedPose> image;
  if (newest_image_ && newest_image_ != before) image = locator_.locate(*newest_image_);
  if (has_own && image) {
    agrees_ = is_same_pose(newest.T_world_odom * T_odom_cam(newest, *newest.T_cam_map), *image);
    contradicts_ = !agrees_;
  }
  if (has_own && !contradicts_) return {true, std::nullopt};
  return {false, image ? std::optional(image->T_world_cam) : std::nullopt};
}

}  // namespace edgevo
